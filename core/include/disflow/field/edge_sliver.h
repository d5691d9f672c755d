// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "disflow/depth/outline.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/field/meeting_faces.h"
#include "disflow/geometry/pinhole_camera.h"
#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// Whether beyond an edge another face of the model still shows, so flat that it has no outline of
/// its own: as it turns into view or out of it. What is seen of it is a sliver narrower than what
/// is looked at beside an outline, and the outline is the sliver's.
/// @param point Object frame.
/// @param most_cos At which its outline would be looked for, between normal and viewing ray.
template <class Field>
[[nodiscard]] bool MayEndInSliver(const Field& field, const EdgePoint& point,
                                  float most_cos) noexcept {
  constexpr float kLeastOutwardCos = 0.5F;  // or it is a face of the near side
  // Such a face runs along the ray: a cell of it lies this far behind the edge.
  const float reach_m = 0.5F * field.config().cell_size_m;
  bool shows = false;
  field.store().ForEachNear(
      point.position_m + reach_m * point.ray, reach_m, [&](auto, const auto& cluster) {
        if (shows) return;
        const Vec3& normal = cluster.mean_normal;
        const float cos_incidence = -normal.dot(point.ray);
        if (cos_incidence <= 0.0F || cos_incidence >= most_cos) return;
        shows = normal.dot(point.outward) > kLeastOutwardCos &&
                normal.dot(point.normal) < kMeetingCos &&
                std::abs(normal.dot(cluster.centroid_m - point.position_m)) < kMeetingReach_m;
      });
  return shows;
}

/// Lets edges that may end in a sliver weigh as little as it may be wide: any width up to what is
/// looked at beside outlines.
/// @param edges Camera frame.
template <class Field, class Edges>
void DoubtSlivers(const Field& field, const PoseObjectFromCamera& T_oc, const PinholeCamera& camera,
                  float most_cos, Edges& edges) noexcept {
  for (EdgePoint& point : edges) {
    if (!MayEndInSliver(field, T_oc * point, most_cos)) continue;
    const float width_m = kFlyingPx * point.position_m.z() / camera.fx_px;
    point.variance_m2 += width_m * width_m / 3.0F;
  }
}

}  // namespace disflow
