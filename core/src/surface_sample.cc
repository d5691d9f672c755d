// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/surface_sample.h"

namespace disflow {

EdgePoint operator*(const PoseObjectFromCamera& T_oc, const EdgePoint& point) noexcept {
  const Mat3& r = T_oc.rotation();
  return {T_oc * point.position_m, r * point.direction, r * point.normal,
          r * point.ray,           r * point.outward,   point.variance_m2,
          point.depth_variance_m2, point.bend_m,        point.steady};
}

}  // namespace disflow
