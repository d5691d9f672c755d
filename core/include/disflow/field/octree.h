// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "disflow/field/facet_pool.h"
#include "disflow/field/octree_cell.h"
#include "disflow/field/octree_nodes.h"
#include "disflow/types.h"

namespace disflow {

/// Octree over a cube around the object frame's origin, in a bounded pool of nodes (section IV,
/// "Scalability via Octree"). Leaves are cells of fixed size that head a list of local GPs; the two
/// levels above hold running averages of the samples below them (facets), which give a coarse
/// surface for far starts. Facets come from a smaller pool; where it is exhausted the coarse
/// surface has a hole.
template <int kMaxNodes>
class Octree {
 public:
  static constexpr int kDepth = 6;  ///< Levels below the root: 64 cells along each edge.
  static constexpr int kCellsPerEdge = 1 << kDepth;
  static constexpr int kCoarseLevels = 2;
  /// Nodes with facets. Surface fills about four of a node's eight children, so that four of five
  /// nodes are leaves.
  static constexpr int kMaxCoarseNodes = (kMaxNodes + 3) / 4;

  using Cell = OctreeCell;

  void Start(float cell_size_m) noexcept {
    cell_size_m_ = cell_size_m;
    inverse_cell_size_ = 1.0F / cell_size_m;
    nodes_.Start();
    root_ = nodes_.Take(kNoHandle, 0);
    entries_.fill(kNoHandle);
    facets_.Start();
  }

  [[nodiscard]] float cell_size_m() const noexcept { return cell_size_m_; }
  [[nodiscard]] int used_nodes() const noexcept { return nodes_.used(); }

  /// @return false when x is outside of the mapped cube.
  [[nodiscard]] bool CellAt(const Vec3& x_m, Cell& cell) const noexcept {
    const Vec3 scaled = x_m * inverse_cell_size_ + Vec3::Constant(0.5F * kCellsPerEdge);
    // Written so that NaN is outside too.
    if (!((scaled.array() >= 0.0F).all() &&
          (scaled.array() < static_cast<float>(kCellsPerEdge)).all()))
      return false;
    cell = {static_cast<int>(scaled.x()), static_cast<int>(scaled.y()),
            static_cast<int>(scaled.z())};
    return true;
  }
  [[nodiscard]] Vec3 CellMin(const Cell& cell) const noexcept {
    return (Vec3(static_cast<float>(cell.x), static_cast<float>(cell.y),
                 static_cast<float>(cell.z)) -
            Vec3::Constant(0.5F * kCellsPerEdge)) *
           cell_size_m_;
  }

  /// @return The leaf, or kNoHandle if nothing was ever stored there.
  [[nodiscard]] Handle FindLeaf(const Cell& cell) const noexcept {
    return FindAtLevel(cell, kDepth);
  }

  /// The node of a given level (0 = root, kDepth = leaf) that contains a cell.
  [[nodiscard]] Handle FindAtLevel(const Cell& cell, int level) const noexcept {
    const bool below_entry = level >= kEntryLevel;
    Handle node = below_entry ? entries_[EntryIndex(cell)] : root_;
    for (int bit = kDepth - 1 - (below_entry ? kEntryLevel : 0);
         bit >= kDepth - level && node != kNoHandle; --bit) {
      node = at(node).child[Octant(cell, bit)];
    }
    return node;
  }

  /// @return kNoHandle if the node pool is exhausted.
  [[nodiscard]] Handle FindOrCreateLeaf(const Cell& cell) noexcept {
    Handle node = root_;
    for (int bit = kDepth - 1; bit >= 0; --bit) {
      Handle next = at(node).child[Octant(cell, bit)];
      if (next == kNoHandle) {
        next = nodes_.Take(node, static_cast<std::uint8_t>(Octant(cell, bit)));
        if (next == kNoHandle) {
          Prune(node, cell);
          return kNoHandle;
        }
        if (bit == kEntryBit) entries_[EntryIndex(cell)] = next;
        at(node).child[Octant(cell, bit)] = next;
        at(node).children |= static_cast<std::uint8_t>(1U << Octant(cell, bit));
      }
      node = next;
    }
    return node;
  }

  /// Head of a leaf's list of local GPs.
  [[nodiscard]] Handle head(Handle leaf) const noexcept { return at(leaf).first_cluster; }
  void set_head(Handle leaf, Handle cluster) noexcept { at(leaf).first_cluster = cluster; }

  /// Gives a node back to the pool, and its ancestors, as long as they hold nothing.
  /// @param cell One of the node's.
  void Prune(Handle node, const Cell& cell) noexcept {
    while (node != root_ && node != kNoHandle && at(node).empty()) {
      const Handle parent = at(node).parent;
      at(parent).child[at(node).octant] = kNoHandle;
      at(parent).children &= static_cast<std::uint8_t>(~(1U << at(node).octant));
      if (at(node).facets != kNoHandle) facets_.Give(at(node).facets);
      nodes_.Give(node);
      if (entries_[EntryIndex(cell)] == node) entries_[EntryIndex(cell)] = kNoHandle;
      node = parent;
    }
  }

  /// Calls visit(cell, leaf) for every existing leaf that meets the box [low, high]; the caller
  /// bounds the box.
  template <class Visitor>
  void ForEachLeafInBox(const Vec3& low_m, const Vec3& high_m, Visitor&& visit) const noexcept {
    constexpr int kMask = ~((1 << kEntryBit) - 1);
    constexpr int kStep = 1 << kEntryBit;
    const Cell low = ClampedCell(low_m);
    const Cell high = ClampedCell(high_m);
    for (int z = low.z & kMask; z <= high.z; z += kStep) {
      for (int y = low.y & kMask; y <= high.y; y += kStep) {
        for (int x = low.x & kMask; x <= high.x; x += kStep) {
          const Handle entry = entries_[EntryIndex({x, y, z})];
          if (entry != kNoHandle) VisitInBox<kEntryBit - 1>(entry, {x, y, z}, low, high, visit);
        }
      }
    }
  }

  /// Calls visit(cell, leaf) for every leaf, in a fixed order.
  template <class Visitor>
  void ForEachLeaf(Visitor&& visit) const noexcept {
    VisitBelow(root_, 0, Cell{}, visit);
  }

  /// Squared distance from x to a leaf's cell; 0 inside.
  [[nodiscard]] float DistanceSquaredToCell(const Vec3& x_m, const Cell& cell) const noexcept {
    return DistanceSquaredToNode(x_m, cell, kDepth);
  }

  /// Branch and bound: calls visit(leaf, bound_squared_m2), roughly nearest leaf first, for all
  /// leaves nearer to x than the bound, which visit may lower.
  template <class Visitor>
  void VisitNearestFirst(const Vec3& x_m, float& bound_squared_m2, Visitor&& visit) const noexcept {
    VisitNearer(root_, 0, Cell{}, x_m, bound_squared_m2, visit);
  }

  /// Adds (weight +1) or removes (-1) a sample's share in the coarse surface of the levels above
  /// its leaf.
  void UpdateFacets(const Cell& cell, const Vec3& position_m, const Vec3& normal, float weight,
                    float crease_cos) noexcept {
    for (int up = 1; up <= kCoarseLevels; ++up) {
      const Handle node = FindAtLevel(cell, kDepth - up);
      if (node == kNoHandle) continue;
      Handle& sides = at(node).facets;
      if (sides == kNoHandle && weight > 0.0F) sides = facets_.Take();
      if (sides != kNoHandle) facets_.Update(sides, position_m, normal, weight, crease_cos);
    }
  }

  /// The best agreeing facet of the coarse node `up` levels above a cell, or null.
  [[nodiscard]] const Facet* FindFacet(const Cell& cell, int up, const Vec3& normal,
                                       float min_cos) const noexcept {
    const Handle node = FindAtLevel(cell, kDepth - up);
    if (node == kNoHandle || at(node).facets == kNoHandle) return nullptr;
    return facets_.Find(at(node).facets, normal, min_cos);
  }

 private:
  [[nodiscard]] OctreeNode& at(Handle node) noexcept { return nodes_[node]; }
  [[nodiscard]] const OctreeNode& at(Handle node) const noexcept { return nodes_[node]; }

  [[nodiscard]] static std::size_t Octant(const Cell& cell, int bit) noexcept {
    return static_cast<std::size_t>(((cell.x >> bit) & 1) | (((cell.y >> bit) & 1) << 1) |
                                    (((cell.z >> bit) & 1) << 2));
  }

  /// Nodes of this level are found without descending from the root. The table of them is eight
  /// times as large per level: it stays a small part of what the nodes themselves take.
  static constexpr int kEntryLevel = kMaxNodes > 512 ? 4 : 3;
  static constexpr int kEntryBit = kDepth - kEntryLevel;  ///< Of cells' coordinates: the node's.
  static constexpr int kEntriesPerEdge = 1 << kEntryLevel;
  [[nodiscard]] static std::size_t EntryIndex(const Cell& cell) noexcept {
    return static_cast<std::size_t>(
        ((cell.z >> kEntryBit) * kEntriesPerEdge + (cell.y >> kEntryBit)) * kEntriesPerEdge +
        (cell.x >> kEntryBit));
  }

  [[nodiscard]] Cell ClampedCell(const Vec3& x_m) const noexcept {
    const auto clamp = [this](float coordinate_m) {
      const float scaled = coordinate_m * inverse_cell_size_ + 0.5F * kCellsPerEdge;
      constexpr auto kLast = static_cast<float>(kCellsPerEdge - 1);
      const float above = scaled > 0.0F ? scaled : 0.0F;  // NaN too
      return static_cast<int>(above < kLast ? above : kLast);
    };
    return {clamp(x_m.x()), clamp(x_m.y()), clamp(x_m.z())};
  }

  // Recursion depth is kDepth, known at compile time.
  template <class Visitor>
  void VisitBelow(Handle node, int level, const Cell& cell, Visitor& visit) const noexcept {
    if (level == kDepth) {
      visit(cell, node);
      return;
    }
    for (std::size_t octant = 0; octant < 8; ++octant) {
      const Handle child = at(node).child[octant];
      if (child == kNoHandle) continue;
      const auto o = static_cast<int>(octant);
      VisitBelow(child, level + 1,
                 Cell{2 * cell.x + (o & 1), 2 * cell.y + ((o >> 1) & 1), 2 * cell.z + (o >> 2)},
                 visit);
    }
  }

  /// @tparam kBit Of the cells' coordinates that tells the node's children apart.
  /// @param corner The node's first cell.
  template <int kBit, class Visitor>
  void VisitInBox(Handle node, const Cell& corner, const Cell& low, const Cell& high,
                  Visitor& visit) const noexcept {
    const Cell middle{corner.x | 1 << kBit, corner.y | 1 << kBit, corner.z | 1 << kBit};
    unsigned meeting = at(node).children;
    meeting &= (low.x < middle.x ? 0x55U : 0U) | (high.x >= middle.x ? 0xAAU : 0U);
    meeting &= (low.y < middle.y ? 0x33U : 0U) | (high.y >= middle.y ? 0xCCU : 0U);
    meeting &= (low.z < middle.z ? 0x0FU : 0U) | (high.z >= middle.z ? 0xF0U : 0U);
    for (; meeting != 0U; meeting &= meeting - 1U) {
      const auto octant = static_cast<unsigned>(std::countr_zero(meeting));
      const Handle child = at(node).child[octant];
      const Cell cell{(octant & 1U) != 0U ? middle.x : corner.x,
                      (octant & 2U) != 0U ? middle.y : corner.y,
                      (octant & 4U) != 0U ? middle.z : corner.z};
      if constexpr (kBit == 0) {
        visit(cell, child);
      } else {
        VisitInBox<kBit - 1>(child, cell, low, high, visit);
      }
    }
  }

  template <class Visitor>
  void VisitNearer(Handle node, int level, const Cell& cell, const Vec3& x_m,
                   float& bound_squared_m2, Visitor& visit) const noexcept {
    if (DistanceSquaredToNode(x_m, cell, level) >= bound_squared_m2) return;
    if (level == kDepth) {
      visit(node, bound_squared_m2);
      return;
    }
    const Vec3 center_m = NodeMin(cell, level) + Vec3::Constant(0.5F * NodeSize(level));
    const unsigned nearest = (x_m.x() >= center_m.x() ? 1U : 0U) |
                             (x_m.y() >= center_m.y() ? 2U : 0U) |
                             (x_m.z() >= center_m.z() ? 4U : 0U);
    // The child on x's side, its neighbours across one, two and three faces.
    constexpr std::array<unsigned, 8> kFlips{0, 1, 2, 4, 3, 5, 6, 7};
    for (const unsigned flip : kFlips) {
      const unsigned octant = nearest ^ flip;
      const Handle child = at(node).child[octant];
      if (child == kNoHandle) continue;
      const auto o = static_cast<int>(octant);
      VisitNearer(child, level + 1,
                  Cell{2 * cell.x + (o & 1), 2 * cell.y + ((o >> 1) & 1), 2 * cell.z + (o >> 2)},
                  x_m, bound_squared_m2, visit);
    }
  }

  [[nodiscard]] float NodeSize(int level) const noexcept {
    return cell_size_m_ * static_cast<float>(1 << (kDepth - level));
  }
  /// Corner of a node, given its integer coordinates among the nodes of its level.
  [[nodiscard]] Vec3 NodeMin(const Cell& cell, int level) const noexcept {
    const int up = kDepth - level;
    return CellMin(Cell{cell.x << up, cell.y << up, cell.z << up});
  }
  [[nodiscard]] float DistanceSquaredToNode(const Vec3& x_m, const Cell& cell,
                                            int level) const noexcept {
    const Vec3 offset = x_m - NodeMin(cell, level);
    const Vec3 inside = offset.cwiseMax(0.0F).cwiseMin(NodeSize(level));
    return (offset - inside).squaredNorm();
  }

  OctreeNodes<kMaxNodes> nodes_;
  /// By their place among the nodes of their level; kNoHandle where nothing was ever stored.
  std::array<Handle, std::size_t{kEntriesPerEdge} * kEntriesPerEdge * kEntriesPerEdge> entries_;
  FacetPool<kMaxCoarseNodes> facets_;
  float cell_size_m_ = 0.0F;
  float inverse_cell_size_ = 0.0F;
  Handle root_ = 0;
};

}  // namespace disflow
