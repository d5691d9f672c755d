// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/octree.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace disflow::testing {
namespace {

constexpr int kNodes = 512;
constexpr float kCell_m = 0.02F;
using Tree = Octree<kNodes>;
using Place = std::tuple<int, int, int>;

Place PlaceOf(const OctreeCell& cell) { return {cell.x, cell.y, cell.z}; }

/// Leaves as clusters make them: each heads a list.
void AddLeaf(const OctreeCell& cell, Tree& tree) {
  const Handle leaf = tree.FindOrCreateLeaf(cell);
  ASSERT_NE(leaf, kNoHandle);
  tree.set_head(leaf, 0);
}

void RemoveLeaf(const OctreeCell& cell, Tree& tree) {
  const Handle leaf = tree.FindLeaf(cell);
  ASSERT_NE(leaf, kNoHandle);
  tree.set_head(leaf, kNoHandle);
  tree.Prune(leaf, cell);
}

/// Cells around the middle of the tree, where all levels meet, and at its border.
std::vector<OctreeCell> SomeCells() {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> middle(28, 36);
  std::vector<OctreeCell> cells{{0, 0, 0}, {63, 63, 63}, {63, 0, 31}};
  for (int i = 0; i < 100; ++i) cells.push_back({middle(random), middle(random), middle(random)});
  return cells;
}

TEST(Octree, LeavesInABox_AreThoseWhoseCellsMeetIt) {
  Tree tree;
  tree.Start(kCell_m);
  for (const OctreeCell& cell : SomeCells()) AddLeaf(cell, tree);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> coordinate(-0.63F, 0.63F);
  std::uniform_real_distribution<float> size(0.0F, 0.3F);
  int visited = 0;
  for (int i = 0; i < 500; ++i) {
    const float spread = i % 2 == 0 ? 0.1F : 1.0F;
    const Vec3 low_m = spread * Vec3(coordinate(random), coordinate(random), coordinate(random));
    const Vec3 high_m =
        (low_m + spread * Vec3(size(random), size(random), size(random))).cwiseMin(0.635F);
    std::set<Place> found;
    tree.ForEachLeafInBox(low_m, high_m, [&](const OctreeCell& cell, Handle leaf) {
      EXPECT_EQ(tree.FindLeaf(cell), leaf);
      EXPECT_TRUE(found.insert(PlaceOf(cell)).second) << "visited twice";
    });
    std::set<Place> expected;
    tree.ForEachLeaf([&](const OctreeCell& cell, Handle) {
      const Vec3 min_m = tree.CellMin(cell);
      const bool meets = (min_m.array() <= high_m.array()).all() &&
                         (min_m.array() + kCell_m > low_m.array()).all();
      if (meets) expected.insert(PlaceOf(cell));
    });
    EXPECT_EQ(found, expected);
    visited += static_cast<int>(found.size());
  }
  EXPECT_GT(visited, 200);
}

TEST(Octree, PrunedLeaves_GiveTheirNodesBackAndAreNotVisited) {
  Tree tree;
  tree.Start(kCell_m);
  const int empty = tree.used_nodes();
  std::set<Place> places;
  for (const OctreeCell& cell : SomeCells()) {
    AddLeaf(cell, tree);
    places.insert(PlaceOf(cell));
  }
  for (const auto& [x, y, z] : places) RemoveLeaf({x, y, z}, tree);
  EXPECT_EQ(tree.used_nodes(), empty);
  tree.ForEachLeafInBox(Vec3::Constant(-1.0F), Vec3::Constant(1.0F),
                        [](const OctreeCell&, Handle) { ADD_FAILURE(); });
}

TEST(Octree, BoxThatIsNotFinite_VisitsOnlyLeavesThatAreThere) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Tree tree;
  tree.Start(kCell_m);
  for (const OctreeCell& cell : {OctreeCell{0, 0, 0}, OctreeCell{32, 32, 32}}) AddLeaf(cell, tree);
  const auto visited = [&](float low, float high) {
    int count = 0;
    tree.ForEachLeafInBox(Vec3::Constant(low), Vec3::Constant(high),
                          [&](const OctreeCell& cell, Handle leaf) {
                            EXPECT_EQ(tree.FindLeaf(cell), leaf);
                            ++count;
                          });
    return count;
  };
  EXPECT_EQ(visited(-kInfinity, kInfinity), 2);
  EXPECT_EQ(visited(0.0F, kInfinity), 1);
  EXPECT_EQ(visited(kInfinity, -kInfinity), 0);
  // What is no number counts as the lower end.
  EXPECT_EQ(visited(kNan, kNan), 1);
  EXPECT_EQ(visited(kNan, kInfinity), 2);
}

/// One cell in each of the nodes that have facets of their own, far enough apart.
OctreeCell LonelyCell(int i) { return {i % 16 * 4, i / 16 % 16 * 4, i / 256 * 4}; }

TEST(Octree, FacetsThatRunOut_LeaveAHoleUntilOthersAreFreed) {
  Octree<2048> tree;  // more than enough nodes: the facets run out first
  tree.Start(kCell_m);
  constexpr int kCells = Octree<2048>::kMaxCoarseNodes / Octree<2048>::kCoarseLevels;
  const Vec3 up = Vec3::UnitZ();
  const auto add = [&](int i) {
    const OctreeCell cell = LonelyCell(i);
    const Handle leaf = tree.FindOrCreateLeaf(cell);
    ASSERT_NE(leaf, kNoHandle);
    tree.set_head(leaf, 0);
    tree.UpdateFacets(cell, tree.CellMin(cell), up, 1.0F, 0.7F);
  };
  const auto has_facet = [&](int i) {
    return tree.FindFacet(LonelyCell(i), 1, up, 0.5F) != nullptr;
  };
  for (int i = 0; i <= kCells; ++i) add(i);
  for (int i = 0; i < kCells; ++i) EXPECT_TRUE(has_facet(i)) << i;
  EXPECT_FALSE(has_facet(kCells));
  // Takes its share out of the facets of the levels above, then goes away with them.
  tree.UpdateFacets(LonelyCell(3), tree.CellMin(LonelyCell(3)), up, -1.0F, 0.7F);
  const Handle leaf = tree.FindLeaf(LonelyCell(3));
  tree.set_head(leaf, kNoHandle);
  tree.Prune(leaf, LonelyCell(3));
  add(kCells);
  EXPECT_TRUE(has_facet(kCells));
  EXPECT_FALSE(has_facet(3));
}

}  // namespace
}  // namespace disflow::testing
