// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

#include "surface.h"

namespace disflow::apps {

/// A sphere of latitude and longitude patches, outward triangles, normals per vertex if asked for.
[[nodiscard]] inline Surface MakeSphere(double radius_m, const Vec3d& centre, int rings = 128,
                                        bool with_normals = true) {
  Surface sphere;
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double polar = std::numbers::pi * i / rings;
      const double azimuth = std::numbers::pi * 2.0 * j / columns;
      const Vec3d normal(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                         std::cos(polar));
      sphere.vertices.emplace_back(centre + radius_m * normal);
      if (with_normals) sphere.normals.push_back(normal);
    }
  }
  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>(i * (columns + 1) + j);
  };
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < columns; ++j) {
      sphere.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      sphere.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return sphere;
}

}  // namespace disflow::apps
