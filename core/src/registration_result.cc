// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/registration_result.h"

namespace disflow {

float EdgeTrust(float expected_share, int edges, int agreeing) noexcept {
  const float expected = expected_share * static_cast<float>(edges);
  const auto found = static_cast<float>(agreeing);
  return found < expected ? found * found / (expected * expected) : 1.0F;
}

PoseObjectFromCamera StepAbout(const Vec3& center_m, const Vec6& xi,
                               const PoseObjectFromCamera& T_oc) noexcept {
  const Vec3 theta = xi.tail<3>();
  const Mat3 turn = ExpSo3(theta);
  return PoseObjectFromCamera(
             Mat3(turn * T_oc.rotation()),
             Vec3(turn * (T_oc.translation() - center_m) + center_m + xi.head<3>()))
      .Normalized();
}

Vec6 DeviationAbout(const Vec3& center_c, const PoseObjectFromCamera& T_oc,
                    const PoseObjectFromCamera& T_from) noexcept {
  Vec6 deviation;
  deviation.head<3>() = T_oc * center_c - T_from * center_c;
  deviation.tail<3>() = TurnBetween(T_from.rotation(), T_oc.rotation());
  return deviation;
}

}  // namespace disflow
