// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "disflow/memory/fixed_vector.h"
#include "disflow/types.h"

namespace disflow {

/// Index of a pool element; pools hold fewer than kNoHandle elements.
using Handle = std::uint16_t;
inline constexpr Handle kNoHandle = 0xFFFF;

/// Mean surface of one side (similar normals) within a coarse node of the octree.
struct Facet {
  Vec3 position_sum_m;
  Vec3 normal_sum;
  float count;
};

/// Facets of the octree's coarse nodes, a few sides for each node, in a bounded pool.
template <int kMaxNodes>
class FacetPool {
 public:
  static constexpr int kFacetsPerNode = 3;

  void Start() noexcept {
    free_.clear();
    for (int i = kMaxNodes - 1; i >= 0; --i) (void)free_.push_back(static_cast<Handle>(i));
  }

  /// Room for the sides of one node; kNoHandle if there is none.
  [[nodiscard]] Handle Take() noexcept {
    if (free_.empty()) return kNoHandle;
    const Handle sides = free_.back();
    free_.truncate(free_.size() - 1);
    facets_[sides].fill(Empty());
    return sides;
  }
  void Give(Handle sides) noexcept { (void)free_.push_back(sides); }

  /// Adds (weight +1) or removes (-1) a sample's share.
  void Update(Handle sides, const Vec3& position_m, const Vec3& normal, float weight,
              float crease_cos) noexcept {
    Facet* facet = Select(sides, normal, crease_cos, weight > 0.0F);
    if (facet == nullptr) return;
    facet->position_sum_m += weight * position_m;
    facet->normal_sum += weight * normal;
    facet->count += weight;
    if (facet->count < 0.5F) *facet = Empty();
  }

  /// The facet whose normal agrees best, or null.
  [[nodiscard]] const Facet* Find(Handle sides, const Vec3& normal, float min_cos) const noexcept {
    const int best = IndexOf(sides, normal, min_cos);
    return best == kNone ? nullptr : &facets_[sides][static_cast<std::size_t>(best)];
  }

 private:
  static constexpr int kNone = -1;

  [[nodiscard]] static Facet Empty() noexcept { return {Vec3::Zero(), Vec3::Zero(), 0.0F}; }

  [[nodiscard]] int IndexOf(Handle sides, const Vec3& normal, float min_cos) const noexcept {
    int best = kNone;
    float best_cos = min_cos;
    for (int i = 0; i < kFacetsPerNode; ++i) {
      const Facet& facet = facets_[sides][static_cast<std::size_t>(i)];
      if (facet.count <= 0.0F) continue;
      const float cosine = facet.normal_sum.dot(normal) / facet.normal_sum.norm();
      if (cosine > best_cos) {
        best_cos = cosine;
        best = i;
      }
    }
    return best;
  }

  /// The one that agrees, or an unused one if there may be a new one; else null.
  [[nodiscard]] Facet* Select(Handle sides, const Vec3& normal, float crease_cos,
                              bool may_create) noexcept {
    const int found = IndexOf(sides, normal, crease_cos);
    if (found != kNone) return &facets_[sides][static_cast<std::size_t>(found)];
    if (!may_create) return nullptr;
    for (Facet& facet : facets_[sides]) {
      if (facet.count <= 0.0F) return &facet;
    }
    return nullptr;
  }

  std::array<std::array<Facet, static_cast<std::size_t>(kFacetsPerNode)>,
             static_cast<std::size_t>(kMaxNodes)>
      facets_;
  FixedVector<Handle, kMaxNodes> free_;
};

}  // namespace disflow
