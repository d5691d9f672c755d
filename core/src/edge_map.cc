// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/edge_map.h"

#include <cmath>
#include <cstddef>

namespace disflow {
namespace {

bool Agree(const ModelEdge& edge, const EdgePoint& point) noexcept {
  constexpr float kSimilarDirectionCos = 0.94F;
  constexpr float kSimilarNormalCos = 0.8F;
  return std::abs(edge.direction.dot(point.direction)) > kSimilarDirectionCos &&
         edge.normal.dot(point.normal) > kSimilarNormalCos;
}

}  // namespace

int FindNearestEdge(std::span<const ModelEdge> edges, const EdgePoint& point,
                    float radius_m) noexcept {
  int nearest = -1;
  float nearest_squared = radius_m * radius_m;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const float squared = (edges[i].position_m - point.position_m).squaredNorm();
    if (squared < nearest_squared && Agree(edges[i], point)) {
      nearest_squared = squared;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

void MergeIntoEdge(const EdgePoint& point, ModelEdge& edge) noexcept {
  constexpr float kMaxWeight = 20.0F;
  const float gain = 1.0F / (edge.weight + 1.0F);
  const Vec3 offset = point.position_m - edge.position_m;
  // Along the edge nothing is known: only the part across it is averaged.
  edge.position_m += gain * (offset - edge.direction * edge.direction.dot(offset));
  const float sign = edge.direction.dot(point.direction) < 0.0F ? -1.0F : 1.0F;
  edge.direction = (edge.direction + gain * (sign * point.direction - edge.direction)).normalized();
  edge.normal = (edge.normal + gain * (point.normal - edge.normal)).normalized();
  edge.weight = std::fmin(edge.weight + 1.0F, kMaxWeight);
}

}  // namespace disflow
