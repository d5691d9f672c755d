// SPDX-License-Identifier: BSD-3-Clause
#include "nearest_surface.h"

#include <utility>

namespace disflow::apps {
namespace {

/// Samples around a query whose triangles are searched.
constexpr std::size_t kCandidates = 8;

}  // namespace

NearestSurface::NearestSurface(const Surface& surface, std::vector<SurfacePoint> samples)
    : surface_(surface),
      samples_(std::move(samples)),
      positions_(Positions(samples_)),
      index_(positions_) {}

NearestSurface::Hit NearestSurface::Find(const Vec3d& query) const {
  thread_local std::vector<std::uint32_t> nearest;
  index_.Nearest(query, surface_.is_mesh() ? kCandidates : 1, nearest);
  Hit best{samples_[nearest.front()], (positions_[nearest.front()] - query).norm(),
           nearest.front()};
  if (!surface_.is_mesh()) return best;
  for (const std::uint32_t sample : nearest) {
    const std::uint32_t triangle = samples_[sample].element;
    const auto& [a, b, c] = surface_.triangles[triangle];
    const auto& v = surface_.vertices;
    const SurfacePoint point =
        PointOnTriangle(surface_, triangle, NearestBarycentric(v[a], v[b], v[c], query));
    const double distance = (point.position - query).norm();
    if (distance < best.distance) best = {point, distance, best.sample};
  }
  return best;
}

}  // namespace disflow::apps
