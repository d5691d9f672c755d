// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// Triangles over a grid of points that is closed around (columns) and open or closed along
/// (rows). Outside is where columns x rows points.
template <class Surface>
TriangleMesh MeshTube(int columns, int rows, bool closed_rows, const Surface& surface) {
  TriangleMesh mesh;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      mesh.vertices.push_back(surface(2.0 * std::numbers::pi * column / columns, row));
    }
  }
  const auto index = [columns, rows](int column, int row) {
    return static_cast<std::uint32_t>((row % rows) * columns + column % columns);
  };
  for (int row = 0; row + (closed_rows ? 0 : 1) < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const auto a = index(column, row);
      const auto b = index(column + 1, row);
      const auto c = index(column + 1, row + 1);
      const auto d = index(column, row + 1);
      // The first or last row may be a single point drawn many times.
      if (mesh.vertices[a] != mesh.vertices[b]) mesh.triangles.push_back({a, b, c});
      if (mesh.vertices[c] != mesh.vertices[d]) mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

/// A point of a profile: distance from the axis and height.
struct ProfilePoint {
  double radius_m;
  double z_m;
};

/// Circular arc from one angle to another (rad, 0 = outwards, pi/2 = up).
inline void AppendArc(std::vector<ProfilePoint>& profile, ProfilePoint centre, double radius_m,
                      double from_rad, double to_rad, int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double angle = from_rad + (to_rad - from_rad) * i / steps;
    profile.push_back({std::max(0.0, centre.radius_m + radius_m * std::cos(angle)),
                       centre.z_m + radius_m * std::sin(angle)});
  }
}

/// The solid of revolution of a profile about z that goes from the bottom along the outside.
/// @param closed Whether it comes back to where it begins, as of a ring.
inline TriangleMesh MeshProfile(const std::vector<ProfilePoint>& profile, int columns,
                                bool closed = false) {
  return MeshTube(
      columns, static_cast<int>(profile.size()), closed, [&profile](double angle, int row) {
        const ProfilePoint& point = profile[static_cast<std::size_t>(row)];
        return Vec3d(point.radius_m * std::cos(angle), point.radius_m * std::sin(angle), point.z_m);
      });
}

}  // namespace disflow::host
