// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "disflow/host/random.h"

namespace disflow::host {

double BoundingRadius(const TriangleMesh& mesh) {
  double squared = 0.0;
  for (const Vec3d& vertex : mesh.vertices) squared = std::max(squared, vertex.squaredNorm());
  return std::sqrt(squared);
}

void MoveCentreToOrigin(TriangleMesh& mesh) {
  Vec3d low = Vec3d::Constant(std::numeric_limits<double>::max());
  Vec3d high = -low;
  for (const Vec3d& vertex : mesh.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  const Vec3d centre = 0.5 * (low + high);
  for (Vec3d& vertex : mesh.vertices) vertex -= centre;
}

void Append(const TriangleMesh& part, const Vec3d& at_m, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3d& vertex : part.vertices) mesh.vertices.push_back(Vec3d(vertex + at_m));
  for (const auto& t : part.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

std::vector<Vec3d> SampleSurface(const TriangleMesh& mesh, int count) {
  std::vector<double> area_until;  // sum of the areas up to and including a triangle
  double area = 0.0;
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const Vec3d& a = mesh.vertices[t[0]];
    area += 0.5 * (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).norm();
    area_until.push_back(area);
  }
  std::vector<Vec3d> points;
  if (area_until.empty()) return points;
  RandomNumbers random(1);
  for (int i = 0; i < count; ++i) {
    // One draw per equal share of the area: more even than independent draws.
    const double at = area * (i + random.Uniform()) / count;
    const auto found = std::upper_bound(area_until.begin(), area_until.end() - 1, at);
    const auto& t = mesh.triangles[static_cast<std::size_t>(found - area_until.begin())];
    const double root = std::sqrt(random.Uniform());
    const double share = random.Uniform();
    points.emplace_back((1.0 - root) * mesh.vertices[t[0]] +
                        root * (1.0 - share) * mesh.vertices[t[1]] +
                        root * share * mesh.vertices[t[2]]);
  }
  return points;
}

}  // namespace disflow::host
