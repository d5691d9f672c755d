// SPDX-License-Identifier: BSD-3-Clause
#include "surface.h"

#include <algorithm>
#include <cmath>

namespace disflow::apps {
namespace {

Vec3d AreaVector(const Surface& surface, std::uint32_t triangle) {
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vec3d ab = surface.vertices[b] - surface.vertices[a];
  const Vec3d ac = surface.vertices[c] - surface.vertices[a];
  return 0.5 * ab.cross(ac);
}

Vec3d Normalised(const Vec3d& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3d(v / length) : Vec3d::Zero();
}

double Fraction(double x) { return x - std::floor(x); }

/// The i-th point of the R2 low-discrepancy sequence (M. Roberts, 2018), folded into a triangle.
Vec3d SpreadBarycentric(std::size_t i) {
  const auto n = static_cast<double>(i);
  double u = Fraction(0.5 + 0.7548776662466927 * n);
  double v = Fraction(0.5 + 0.5698402909980532 * n);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return {1.0 - u - v, u, v};
}

std::vector<SurfacePoint> CloudPoints(const Surface& surface) {
  std::vector<SurfacePoint> points(surface.vertices.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].position = surface.vertices[i];
    if (!surface.normals.empty()) points[i].normal = surface.normals[i];
    points[i].element = static_cast<std::uint32_t>(i);
  }
  return points;
}

}  // namespace

SurfacePoint PointOnTriangle(const Surface& surface, std::uint32_t triangle,
                             const Vec3d& barycentric) {
  SurfacePoint point;
  point.element = triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t vertex = surface.triangles[triangle][i];
    const double share = barycentric[static_cast<Eigen::Index>(i)];
    point.position += share * surface.vertices[vertex];
    if (!surface.normals.empty()) point.normal += share * surface.normals[vertex];
  }
  if (surface.normals.empty()) point.normal = AreaVector(surface, triangle);
  point.normal = Normalised(point.normal);
  return point;
}

std::vector<SurfacePoint> SampleSurface(const Surface& surface, std::size_t count) {
  if (!surface.is_mesh()) return CloudPoints(surface);
  std::vector<double> area_up_to(surface.triangles.size());
  double total = 0.0;
  for (std::size_t i = 0; i < area_up_to.size(); ++i) {
    total += AreaVector(surface, static_cast<std::uint32_t>(i)).norm();
    area_up_to[i] = total;
  }
  std::vector<SurfacePoint> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double area = total * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, area);
    const auto triangle = static_cast<std::uint32_t>(found - area_up_to.begin());
    points.push_back(PointOnTriangle(surface, triangle, SpreadBarycentric(i)));
  }
  return points;
}

std::vector<Vec3d> Positions(const std::vector<SurfacePoint>& points) {
  std::vector<Vec3d> positions;
  positions.reserve(points.size());
  for (const SurfacePoint& point : points) positions.push_back(point.position);
  return positions;
}

Vec3d NearestBarycentric(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& query) {
  const Vec3d ab = b - a;
  const Vec3d ac = c - a;
  const Vec3d ap = query - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const Vec3d bp = query - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {1.0 - t, t, 0.0};
  }
  const Vec3d cp = query - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {1.0 - t, 0.0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace disflow::apps
