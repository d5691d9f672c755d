// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_surface.h"

#include <utility>

namespace disflow::apps {
namespace {

/// Anchors around a query whose triangles are searched.
constexpr std::size_t kCandidates = 8;

std::vector<SurfacePoint> WithEveryTriangle(const Surface& surface,
                                            std::vector<SurfacePoint> points) {
  std::vector<bool> has_point(surface.triangles.size(), false);
  if (surface.is_mesh()) {
    for (const SurfacePoint& point : points) has_point[point.element] = true;
  }
  for (std::uint32_t i = 0; i < has_point.size(); ++i) {
    if (has_point[i]) continue;
    points.push_back(PointOnTriangle(surface, i, Vec3d::Constant(1.0 / 3.0)));
  }
  return points;
}

}  // namespace

NearestSurface::NearestSurface(const Surface& surface, std::vector<SurfacePoint> samples)
    : surface_(surface),
      samples_(std::move(samples)),
      sample_positions_(Positions(samples_)),
      sample_index_(sample_positions_),
      anchors_(WithEveryTriangle(surface_, samples_)),
      anchor_positions_(Positions(anchors_)),
      anchor_index_(anchor_positions_) {}

NearestSurface::Hit NearestSurface::Find(const Vec3d& query) const {
  thread_local std::vector<std::uint32_t> nearest;
  sample_index_.Nearest(query, 1, nearest);
  const std::uint32_t sample = nearest.front();
  Hit best{samples_[sample], (sample_positions_[sample] - query).norm(), sample};
  if (!surface_.is_mesh()) return best;
  anchor_index_.Nearest(query, kCandidates, nearest);
  for (const std::uint32_t anchor : nearest) {
    const std::uint32_t triangle = anchors_[anchor].element;
    const auto& [a, b, c] = surface_.triangles[triangle];
    const auto& v = surface_.vertices;
    const SurfacePoint point =
        PointOnTriangle(surface_, triangle, NearestBarycentric(v[a], v[b], v[c], query));
    const double distance = (point.position - query).norm();
    if (distance < best.distance) best = {point, distance, sample};
  }
  return best;
}

}  // namespace disflow::apps
