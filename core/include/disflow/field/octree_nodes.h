// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "disflow/field/facet_pool.h"

namespace disflow {

struct OctreeNode {
  std::array<Handle, 8> child;
  Handle parent;  ///< Next free node while in the free list.
  Handle first_cluster;
  Handle facets;          ///< Of a coarse node with samples below, else kNoHandle.
  std::uint8_t children;  ///< Bit i: child i exists.
  std::uint8_t octant;    ///< Place among the parent's children.

  [[nodiscard]] bool empty() const noexcept { return first_cluster == kNoHandle && children == 0; }
};

/// The bounded pool of an octree's nodes. Start() it before first use.
template <int kMaxNodes>
class OctreeNodes {
  static_assert(kMaxNodes < kNoHandle);

 public:
  void Start() noexcept {
    for (int i = 0; i < kMaxNodes; ++i) {
      nodes_[static_cast<std::size_t>(i)].parent =
          static_cast<Handle>(i + 1 < kMaxNodes ? i + 1 : kNoHandle);
    }
    free_head_ = 0;
    used_ = 0;
  }

  [[nodiscard]] int used() const noexcept { return used_; }
  [[nodiscard]] OctreeNode& operator[](Handle node) noexcept { return nodes_[node]; }
  [[nodiscard]] const OctreeNode& operator[](Handle node) const noexcept { return nodes_[node]; }

  /// A node without children. @return kNoHandle if the pool is exhausted.
  [[nodiscard]] Handle Take(Handle parent, std::uint8_t octant) noexcept {
    const Handle node = free_head_;
    if (node == kNoHandle) return kNoHandle;
    OctreeNode& taken = nodes_[node];
    free_head_ = taken.parent;
    ++used_;
    taken.child.fill(kNoHandle);
    taken.parent = parent;
    taken.first_cluster = kNoHandle;
    taken.facets = kNoHandle;
    taken.children = 0;
    taken.octant = octant;
    return node;
  }
  /// Takes a node back that its parent no longer knows.
  void Give(Handle node) noexcept {
    nodes_[node].parent = free_head_;
    free_head_ = node;
    --used_;
  }

 private:
  std::array<OctreeNode, static_cast<std::size_t>(kMaxNodes)> nodes_;
  Handle free_head_ = 0;
  int used_ = 0;
};

}  // namespace disflow
