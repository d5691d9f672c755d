// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <limits>
#include <optional>

#include "disflow/host/rigid_state.h"

namespace disflow::host {

/// Depth at which the ray through a pixel enters an axis-aligned box about the object's origin;
/// the independent check of the renderer.
/// @param ray_c Direction with z = 1, camera frame.
[[nodiscard]] inline std::optional<double> BoxDepth(const Vec3d& half_size,
                                                    const Transform<Camera, Object, double>& T_co,
                                                    const Vec3d& ray_c) {
  const Vec3d origin = T_co.Inverse() * Vec3d(Vec3d::Zero());
  const Vec3d ray = T_co.rotation().transpose() * ray_c;
  double enter = -std::numeric_limits<double>::max();
  double leave = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i) {
    const double a = (-half_size[i] - origin[i]) / ray[i];
    const double b = (half_size[i] - origin[i]) / ray[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  if (enter > leave) return std::nullopt;
  return enter;
}

}  // namespace disflow::host
