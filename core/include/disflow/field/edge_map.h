// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "disflow/depth/surface_sample.h"
#include "disflow/estimate.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// The object's sharp edges, as running averages of the occluding-edge points seen on them. Object
/// frame.
template <int kMaxEdges>
class EdgeMap {
 public:
  struct Edge {
    Vec3 position_m;
    Vec3 direction;
    Vec3 normal;
    float weight;  ///< Observations, bounded so that an edge can still move.
  };

  void Start() noexcept { edges_.clear(); }
  [[nodiscard]] int size() const noexcept { return edges_.size(); }

  /// The nearest edge with the same direction and side, within radius_m; or null.
  [[nodiscard]] const Edge* FindNearest(const EdgePoint& point, float radius_m) const noexcept {
    return Find(edges_, point, radius_m);
  }

  /// Averages a point into the edge near it, or stores it while there is room.
  void Insert(const EdgePoint& point, float merge_radius_m, Counters& counters) noexcept {
    constexpr float kMaxWeight = 20.0F;
    Edge* edge = Find(edges_, point, merge_radius_m);
    if (edge == nullptr) {
      if (!edges_.push_back({point.position_m, point.direction, point.normal, 1.0F}))
        ++counters.edges_refused;
      return;
    }
    const float gain = 1.0F / (edge->weight + 1.0F);
    const Vec3 offset = point.position_m - edge->position_m;
    // Along the edge nothing is known: only the part across it is averaged.
    edge->position_m += gain * (offset - edge->direction * edge->direction.dot(offset));
    const float sign = edge->direction.dot(point.direction) < 0.0F ? -1.0F : 1.0F;
    edge->direction =
        (edge->direction + gain * (sign * point.direction - edge->direction)).normalized();
    edge->normal = (edge->normal + gain * (point.normal - edge->normal)).normalized();
    edge->weight = std::fmin(edge->weight + 1.0F, kMaxWeight);
  }

 private:
  template <class Edges>
  [[nodiscard]] static auto Find(Edges& edges, const EdgePoint& point, float radius_m) noexcept
      -> decltype(edges.begin()) {
    decltype(edges.begin()) nearest = nullptr;
    float nearest_squared = radius_m * radius_m;
    for (auto& edge : edges) {
      const float squared = (edge.position_m - point.position_m).squaredNorm();
      if (squared < nearest_squared && Agree(edge, point)) {
        nearest_squared = squared;
        nearest = &edge;
      }
    }
    return nearest;
  }

  [[nodiscard]] static bool Agree(const Edge& edge, const EdgePoint& point) noexcept {
    constexpr float kSimilarDirectionCos = 0.94F;
    constexpr float kSimilarNormalCos = 0.8F;
    return std::abs(edge.direction.dot(point.direction)) > kSimilarDirectionCos &&
           edge.normal.dot(point.normal) > kSimilarNormalCos;
  }

  FixedVector<Edge, kMaxEdges> edges_;
};

}  // namespace disflow
