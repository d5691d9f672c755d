// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "frames.h"

namespace disflow::apps {

/// A triangle mesh, or a point cloud if it has no triangles. Indices are within `vertices`.
struct Surface {
  std::vector<Vec3d> vertices;
  std::vector<Vec3d> normals;  ///< Per vertex, outward, unit length; or empty.
  std::vector<double> stds_m;  ///< Per vertex, standard deviation along the normal; or empty.
  std::vector<std::array<std::uint32_t, 3>> triangles;

  [[nodiscard]] bool is_mesh() const { return !triangles.empty(); }
  /// Whether normals are known: of the vertices, or else of the triangles.
  [[nodiscard]] bool has_normals() const { return is_mesh() || !normals.empty(); }
};

/// A point on a surface.
struct SurfacePoint {
  Vec3d position = Vec3d::Zero();
  Vec3d normal = Vec3d::Zero();  ///< Unit length; zero if unknown.
  std::uint32_t element = 0;     ///< Number of its triangle, or of its vertex in a point cloud.
};

/// Points spread evenly over the area of a mesh, the same on every call. The points of a cloud are
/// returned as they are, whatever `count`.
[[nodiscard]] std::vector<SurfacePoint> SampleSurface(const Surface& surface, std::size_t count);

/// The positions alone.
[[nodiscard]] std::vector<Vec3d> Positions(const std::vector<SurfacePoint>& points);

/// Moves a surface into another frame.
template <class To, class From>
[[nodiscard]] Surface Move(const Transform<To, From, double>& T, Surface surface) {
  for (Vec3d& vertex : surface.vertices) vertex = T * vertex;
  for (Vec3d& normal : surface.normals) normal = T.rotation() * normal;
  return surface;
}

/// The point of a triangle at barycentric coordinates, with the vertices' normal there (the
/// triangle's own if the surface has none).
[[nodiscard]] SurfacePoint PointOnTriangle(const Surface& surface, std::uint32_t triangle,
                                           const Vec3d& barycentric);

/// Barycentric coordinates of the point of triangle abc that is nearest to `query` (Ericson,
/// "Real-Time Collision Detection", section 5.1.5).
[[nodiscard]] Vec3d NearestBarycentric(const Vec3d& a, const Vec3d& b, const Vec3d& c,
                                       const Vec3d& query);

}  // namespace disflow::apps
