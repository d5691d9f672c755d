// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "disflow/types.h"

namespace disflow {

/// Whether surface of the model lies within a distance of a point, whatever its normal. Judged by
/// the planes of the local GPs' clusters: cheap enough to ask hundreds of times per frame.
/// @param x_m Object frame.
template <class Field>
[[nodiscard]] bool IsNearSurface(const Field& field, const Vec3& x_m, float distance_m) noexcept {
  const float reach_m = field.config().cell_size_m;
  bool near = false;
  const auto look_at = [&](auto, const auto& cluster) {
    if (near) return;
    const Vec3 offset = x_m - cluster.centroid_m;
    const float height_m = cluster.mean_normal.dot(offset);
    const float along_squared = offset.squaredNorm() - height_m * height_m;
    near = std::abs(height_m) < distance_m && along_squared < reach_m * reach_m;
  };
  // Most often the point's own cell tells.
  field.store().ForEachNear(x_m, 0.0F, look_at);
  if (!near) field.store().ForEachNear(x_m, distance_m, look_at);
  return near;
}

}  // namespace disflow
