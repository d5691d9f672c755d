// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "disflow/geometry/pinhole_camera.h"

namespace consumer {

inline constexpr int kWidth = 160;
inline constexpr int kHeight = 120;
inline constexpr disflow::PinholeCamera kCamera{200.0F, 200.0F, 80.0F, 60.0F};

/// The corner of a cube that points at the camera and moves sideways, in 16-bit millimetres;
/// replace it by your camera.
inline void TakeImage(double time_s, const disflow::PinholeCamera& camera,
                      std::vector<std::uint16_t>& depth_mm) {
  const disflow::Vec3 corner(static_cast<float>(0.1 * time_s), 0.0F, 0.55F);
  const disflow::Vec3 faces[] = {{0.8F, 0.0F, -0.6F}, {-0.4F, 0.7F, -0.6F}, {-0.4F, -0.7F, -0.6F}};
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const disflow::Vec3 ray = camera.Ray(static_cast<float>(u), static_cast<float>(v));
      float depth_m = 0.0F;
      for (const disflow::Vec3& normal : faces)
        depth_m = std::fmax(depth_m, normal.dot(corner) / normal.dot(ray));
      if (depth_m > corner.z() + 0.08F) depth_m = 0.0F;
      depth_mm[static_cast<std::size_t>(v * kWidth + u)] =
          static_cast<std::uint16_t>(1000.0F * depth_m + 0.5F);
    }
  }
}

}  // namespace consumer
