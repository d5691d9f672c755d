// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "disflow/estimate.h"
#include "disflow/field/cluster.h"
#include "disflow/field/octree.h"

namespace disflow {

/// The bounded pools of octree nodes and local GPs, and who lies where. When a pool is full those
/// clusters make room that were not observed for the longest time.
template <class Limits>
class ClusterStore {
 public:
  using ClusterType = Cluster<Limits::kMaxSamplesPerCluster, Limits::kMaxTrainingSamples>;
  using Tree = Octree<Limits::kMaxNodes>;
  static_assert(Limits::kMaxClusters < kNoHandle);

  void Start(float cell_size_m, float crease_cos) noexcept {
    crease_cos_ = crease_cos;
    tree_.Start(cell_size_m);
    for (int i = 0; i < Limits::kMaxClusters; ++i) {
      ClusterType& cluster = clusters_[static_cast<std::size_t>(i)];
      cluster.used = false;
      cluster.next = static_cast<Handle>(i + 1 < Limits::kMaxClusters ? i + 1 : kNoHandle);
    }
    free_head_ = 0;
    used_ = 0;
  }

  [[nodiscard]] ClusterType& operator[](Handle handle) noexcept { return clusters_[handle]; }
  [[nodiscard]] const ClusterType& operator[](Handle handle) const noexcept {
    return clusters_[handle];
  }
  [[nodiscard]] int size() const noexcept { return used_; }
  [[nodiscard]] const Tree& tree() const noexcept { return tree_; }

  /// visit(handle, cluster) for all clusters whose cells meet the ball, whatever their normals.
  template <class Visitor>
  void ForEachNear(const Vec3& x_m, float radius_m, Visitor&& visit) const noexcept {
    const Vec3 reach = Vec3::Constant(radius_m);
    tree_.ForEachLeafInBox(x_m - reach, x_m + reach, [&](const OctreeCell&, Handle leaf) {
      for (Handle h = tree_.head(leaf); h != kNoHandle; h = clusters_[h].next)
        visit(h, clusters_[h]);
    });
  }

  /// The cluster with the nearest centroid among those near x whose normal agrees, or kNoHandle.
  [[nodiscard]] Handle FindNearest(const Vec3& x_m, const Vec3& normal, float radius_m,
                                   float min_cos) const noexcept {
    Handle best = kNoHandle;
    float best_squared = 0.0F;
    const auto look_into = [&](Handle leaf) {
      for (Handle h = tree_.head(leaf); h != kNoHandle; h = clusters_[h].next) {
        const ClusterType& cluster = clusters_[h];
        if (cluster.mean_normal.dot(normal) < min_cos) continue;
        const float squared = (cluster.centroid_m - x_m).squaredNorm();
        if (best == kNoHandle || squared < best_squared) {
          best = h;
          best_squared = squared;
        }
      }
    };
    // Most often the own cell has one, and cells that are farther off need not be looked into.
    OctreeCell cell;
    const Handle own = tree_.CellAt(x_m, cell) ? tree_.FindLeaf(cell) : kNoHandle;
    if (own != kNoHandle) look_into(own);
    const float reach_m =
        best == kNoHandle
            ? radius_m
            : std::min(radius_m, std::sqrt(best_squared) + kWander * tree_.cell_size_m());
    const Vec3 reach = Vec3::Constant(reach_m);
    tree_.ForEachLeafInBox(x_m - reach, x_m + reach, [&](const OctreeCell&, Handle leaf) {
      if (leaf != own) look_into(leaf);
    });
    return best;
  }

  /// The cluster to which a sample belongs: same cell, same side of a crease. Made if need be.
  /// @return kNoHandle if x is out of bounds or if no room could be made.
  [[nodiscard]] Handle FindOrCreate(const Vec3& x_m, const Vec3& normal, std::uint32_t frame,
                                    Counters& counters) noexcept {
    OctreeCell cell;
    if (!tree_.CellAt(x_m, cell)) {
      ++counters.observations_out_of_bounds;
      return kNoHandle;
    }
    Handle leaf = tree_.FindLeaf(cell);
    if (leaf != kNoHandle) {
      const Handle existing = SelectSide(leaf, normal);
      if (existing != kNoHandle) return existing;
    }
    if (free_head_ != kNoHandle || EvictStalest(frame, counters)) {
      leaf = tree_.FindOrCreateLeaf(cell);
      while (leaf == kNoHandle && EvictStalestLeaf(frame, counters))
        leaf = tree_.FindOrCreateLeaf(cell);
      if (leaf != kNoHandle) return Take(cell, leaf);
    }
    ++counters.samples_refused;
    return kNoHandle;
  }

  /// Accounts for a sample that was added to a cluster.
  void OnSampleAdded(const ClusterType& cluster, const ModelSample& sample) noexcept {
    tree_.UpdateFacets(cluster.cell, sample.position_m, sample.normal, 1.0F, crease_cos_);
  }

  /// Gives a cluster that is not believed back to the pool.
  void Forget(Handle handle, Counters& counters) noexcept {
    ++counters.clusters_forgotten;
    Release(handle);
  }

  template <class Visitor>
  void ForEach(Visitor&& visit) const noexcept {
    for (int i = 0; i < Limits::kMaxClusters; ++i) {
      const ClusterType& cluster = clusters_[static_cast<std::size_t>(i)];
      if (cluster.used) visit(static_cast<Handle>(i), cluster);
    }
  }

 private:
  /// How far the centroid of averaged samples may have left its cell, in cells.
  static constexpr float kWander = 0.1F;

  [[nodiscard]] Handle SelectSide(Handle leaf, const Vec3& normal) const noexcept {
    Handle best = kNoHandle;
    float best_cos = crease_cos_;
    for (Handle h = tree_.head(leaf); h != kNoHandle; h = clusters_[h].next) {
      const float cosine = clusters_[h].mean_normal.dot(normal);
      if (cosine > best_cos) {
        best_cos = cosine;
        best = h;
      }
    }
    return best;
  }

  [[nodiscard]] Handle Take(const OctreeCell& cell, Handle leaf) noexcept {
    const Handle handle = free_head_;
    free_head_ = clusters_[handle].next;
    ++used_;
    clusters_[handle].Start(cell, tree_.CellMin(cell), tree_.cell_size_m(), leaf, tree_.head(leaf));
    tree_.set_head(leaf, handle);
    return handle;
  }

  /// Frees the cluster that was not observed for the longest time. Clusters seen in this very frame
  /// stay.
  [[nodiscard]] bool EvictStalest(std::uint32_t frame, Counters& counters) noexcept {
    Handle stalest = kNoHandle;
    ForEach([&](Handle handle, const ClusterType& cluster) {
      if (cluster.last_frame >= frame) return;
      if (stalest == kNoHandle || cluster.last_frame < clusters_[stalest].last_frame)
        stalest = handle;
    });
    if (stalest == kNoHandle) return false;
    ++counters.clusters_evicted;
    Release(stalest);
    return true;
  }

  /// Frees the clusters of the leaf that was not observed for the longest time, and with them its
  /// node: a cluster that shares its leaf with others would be lost for nothing.
  [[nodiscard]] bool EvictStalestLeaf(std::uint32_t frame, Counters& counters) noexcept {
    Handle stalest = kNoHandle;
    std::uint32_t stalest_frame = frame;
    ForEach([&](Handle handle, const ClusterType& cluster) {
      if (tree_.head(cluster.leaf) != handle) return;
      const std::uint32_t observed = LastFrameOf(cluster.leaf);
      if (observed >= stalest_frame) return;
      stalest_frame = observed;
      stalest = handle;
    });
    while (stalest != kNoHandle) {
      const Handle next = clusters_[stalest].next;
      ++counters.clusters_evicted;
      Release(stalest);
      stalest = next;
    }
    return stalest_frame < frame;
  }

  /// When any cluster of a leaf was last observed.
  [[nodiscard]] std::uint32_t LastFrameOf(Handle leaf) const noexcept {
    std::uint32_t last_frame = 0;
    for (Handle h = tree_.head(leaf); h != kNoHandle; h = clusters_[h].next)
      last_frame = std::max(last_frame, clusters_[h].last_frame);
    return last_frame;
  }

  void Release(Handle handle) noexcept {
    ClusterType& cluster = clusters_[handle];
    for (const ModelSample& sample : cluster.samples) {
      tree_.UpdateFacets(cluster.cell, sample.position_m, sample.normal, -1.0F, crease_cos_);
    }
    if (tree_.head(cluster.leaf) == handle) {
      tree_.set_head(cluster.leaf, cluster.next);
    } else {
      Handle previous = tree_.head(cluster.leaf);
      while (clusters_[previous].next != handle) previous = clusters_[previous].next;
      clusters_[previous].next = cluster.next;
    }
    tree_.Prune(cluster.leaf, cluster.cell);
    cluster.used = false;
    cluster.next = free_head_;
    free_head_ = handle;
    --used_;
  }

  Tree tree_;
  std::array<ClusterType, static_cast<std::size_t>(Limits::kMaxClusters)> clusters_;
  float crease_cos_ = 0.0F;
  Handle free_head_ = 0;
  int used_ = 0;
};

}  // namespace disflow
