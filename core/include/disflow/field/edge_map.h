// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "disflow/depth/surface_sample.h"
#include "disflow/estimate.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// A sharp edge of the model: a running average of the occluding-edge points seen on it. Object
/// frame.
struct ModelEdge {
  Vec3 position_m;
  Vec3 direction;
  Vec3 normal;
  float weight;  ///< Observations, bounded so that an edge can still move.
};

/// The nearest edge with the same direction and side as a point, within radius_m.
/// @return Its index, or -1.
[[nodiscard]] int FindNearestEdge(std::span<const ModelEdge> edges, const EdgePoint& point,
                                  float radius_m) noexcept;

/// Averages a point into an edge.
void MergeIntoEdge(const EdgePoint& point, ModelEdge& edge) noexcept;

/// The object's sharp edges. Object frame.
template <int kMaxEdges>
class EdgeMap {
 public:
  using Edge = ModelEdge;

  void Start() noexcept { edges_.clear(); }
  [[nodiscard]] int size() const noexcept { return edges_.size(); }

  /// The nearest edge with the same direction and side, within radius_m; or null.
  [[nodiscard]] const Edge* FindNearest(const EdgePoint& point, float radius_m) const noexcept {
    const int nearest = Find(point, radius_m);
    return nearest < 0 ? nullptr : &edges_[nearest];
  }

  /// Averages a point into the edge near it, or stores it while there is room.
  void Insert(const EdgePoint& point, float merge_radius_m, Counters& counters) noexcept {
    const int nearest = Find(point, merge_radius_m);
    if (nearest >= 0) {
      MergeIntoEdge(point, edges_[nearest]);
    } else if (!edges_.push_back({point.position_m, point.direction, point.normal, 1.0F})) {
      ++counters.edges_refused;
    }
  }

 private:
  [[nodiscard]] int Find(const EdgePoint& point, float radius_m) const noexcept {
    return FindNearestEdge({edges_.begin(), edges_.end()}, point, radius_m);
  }

  FixedVector<Edge, kMaxEdges> edges_;
};

}  // namespace disflow
