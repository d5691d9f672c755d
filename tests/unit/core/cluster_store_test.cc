// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/cluster_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include "disflow/limits.h"

namespace disflow::testing {
namespace {

constexpr float kCell_m = 0.02F;
constexpr float kCreaseCos = 0.7F;

/// As Edge, but with so many nodes and clusters.
template <int kNodes, int kClusters>
struct Pools : profiles::Edge {
  static constexpr int kMaxNodes = kNodes;
  static constexpr int kMaxClusters = kClusters;
};

/// Six sides of which none agrees with another.
Vec3 Side(int i) { return (i % 2 == 0 ? 1.0F : -1.0F) * Vec3::Unit(i / 2); }

/// Where a cluster belongs: cell and side.
using Place = std::tuple<int, int, int, int>;
struct Remembered {
  Place place;
  std::uint32_t last_frame;
};

Vec3 MiddleOf(const Place& place) {
  const auto [x, y, z, side] = place;
  constexpr float kHalf = 0.5F * Octree<8>::kCellsPerEdge;
  return kCell_m * (Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) -
                    Vec3::Constant(kHalf - 0.5F));
}

/// A store and a simple list of what it should hold.
template <class Limits>
class CheckedStore {
 public:
  using Store = ClusterStore<Limits>;

  CheckedStore() { store_->Start(kCell_m, kCreaseCos); }

  /// One observation, as the distance field inserts it.
  Handle Observe(const Place& place, std::uint32_t frame) {
    const Vec3 x_m = MiddleOf(place);
    const Vec3 normal = Side(std::get<3>(place));
    const Counters before = counters_;
    const Handle handle = store_->FindOrCreate(x_m, normal, frame, counters_);
    Forget(before, frame);
    if (handle == kNoHandle) {
      EXPECT_EQ(counters_.samples_refused, before.samples_refused + 1) << "counted once";
      return handle;
    }
    EXPECT_EQ(counters_.samples_refused, before.samples_refused);
    auto& cluster = (*store_)[handle];
    cluster.last_frame = frame;
    const ModelSample sample{x_m, normal, 1e-8F, 1e-3F, 1};
    if (cluster.samples.push_back(sample)) {
      cluster.UpdateMeans();
      store_->OnSampleAdded(cluster, sample);
    }
    Remember(place, frame);
    return handle;
  }

  /// Everything that can be asked of the store agrees with the list.
  void ExpectConsistent() {
    ASSERT_EQ(store_->size(), static_cast<int>(known_.size()));
    std::set<Handle> used;
    std::set<Place> places;
    store_->ForEach([&](Handle handle, const auto& cluster) {
      used.insert(handle);
      const Place place = PlaceOf(cluster);
      EXPECT_TRUE(places.insert(place).second) << "twice";
      EXPECT_NE(Find(place), known_.end()) << "was evicted";
      EXPECT_EQ(store_->tree().FindLeaf(cluster.cell), cluster.leaf);
    });
    EXPECT_EQ(used.size(), known_.size());
    std::set<Handle> listed;
    std::set<std::tuple<int, int, int, int>> nodes{{0, 0, 0, 0}};
    store_->tree().ForEachLeaf([&](const OctreeCell& cell, Handle leaf) {
      EXPECT_NE(store_->tree().head(leaf), kNoHandle) << "a leaf that holds nothing";
      for (int level = 1; level <= Store::Tree::kDepth; ++level) {
        const int up = Store::Tree::kDepth - level;
        nodes.insert({level, cell.x >> up, cell.y >> up, cell.z >> up});
      }
      for (Handle h = store_->tree().head(leaf); h != kNoHandle; h = (*store_)[h].next) {
        ASSERT_TRUE(listed.insert(h).second) << "in two lists, or in a circle";
        EXPECT_EQ((*store_)[h].leaf, leaf);
      }
    });
    EXPECT_TRUE(listed == used);
    EXPECT_EQ(store_->tree().used_nodes(), static_cast<int>(nodes.size()));
  }

  [[nodiscard]] bool Knows(const Place& place) const {
    bool knows = false;
    store_->ForEach(
        [&](Handle, const auto& cluster) { knows = knows || PlaceOf(cluster) == place; });
    return knows;
  }
  [[nodiscard]] const Counters& counters() const { return counters_; }
  [[nodiscard]] Store& store() { return *store_; }
  [[nodiscard]] const std::vector<Remembered>& known() const { return known_; }

 private:
  template <class ClusterType>
  [[nodiscard]] static Place PlaceOf(const ClusterType& cluster) {
    int side = 0;
    for (int i = 0; i < 6; ++i) {
      if (!cluster.samples.empty() && cluster.mean_normal.dot(Side(i)) > 0.9F) side = i;
    }
    return {cluster.cell.x, cluster.cell.y, cluster.cell.z, side};
  }
  [[nodiscard]] std::vector<Remembered>::iterator Find(const Place& place) {
    return std::find_if(known_.begin(), known_.end(),
                        [&](const Remembered& known) { return known.place == place; });
  }
  void Remember(const Place& place, std::uint32_t frame) {
    const auto at = Find(place);
    if (at == known_.end()) {
      known_.push_back({place, frame});
    } else {
      at->last_frame = frame;
    }
  }
  /// Drops from the list what the store has evicted, and checks that it was right to.
  void Forget(const Counters& before, std::uint32_t frame) {
    std::uint32_t gone = 0;
    for (auto at = known_.begin(); at != known_.end();) {
      if (Knows(at->place)) {
        ++at;
        continue;
      }
      EXPECT_LT(at->last_frame, frame) << "what this very frame has seen stays";
      at = known_.erase(at);
      ++gone;
    }
    EXPECT_EQ(counters_.clusters_evicted - before.clusters_evicted, gone) << "lost without a word";
  }

  std::unique_ptr<Store> store_ = std::make_unique<Store>();
  Counters counters_;
  std::vector<Remembered> known_;
};

Place RandomPlace(std::mt19937& random, int reach) {
  std::uniform_int_distribution<int> cell(32 - reach, 31 + reach);
  std::uniform_int_distribution<int> side(0, 5);
  const int x = cell(random);
  const int y = cell(random);
  const int z = cell(random);
  return {x, y, z, side(random)};
}

TEST(ClusterStore, SamePlace_IsTheSameCluster) {
  CheckedStore<Pools<64, 8>> checked;
  const Handle first = checked.Observe({32, 32, 32, 0}, 1);
  EXPECT_EQ(checked.Observe({32, 32, 32, 0}, 2), first);
  EXPECT_NE(checked.Observe({32, 32, 32, 1}, 2), first) << "the other side of a thin wall";
  EXPECT_NE(checked.Observe({33, 32, 32, 0}, 2), first);
  EXPECT_EQ(checked.store().size(), 3);
  checked.ExpectConsistent();
}

TEST(ClusterStore, RandomObservationsInFewClusters_KeepItConsistent) {
  using Limits = Pools<512, 40>;
  CheckedStore<Limits> checked;
  std::mt19937 random(1);
  for (std::uint32_t frame = 1; frame < 400; ++frame) {
    for (int i = 0; i < 5; ++i) {
      const Place place = RandomPlace(random, 4);
      std::uint32_t stalest = std::numeric_limits<std::uint32_t>::max();
      for (const Remembered& known : checked.known()) stalest = std::min(stalest, known.last_frame);
      const bool full = checked.store().size() == Limits::kMaxClusters;
      const std::vector<Remembered> before = checked.known();
      EXPECT_NE(checked.Observe(place, frame), kNoHandle);
      // With nodes to spare nothing but the stalest cluster goes, and only from a full pool.
      for (const Remembered& known : before) {
        if (checked.Knows(known.place)) continue;
        EXPECT_TRUE(full);
        EXPECT_EQ(known.last_frame, stalest);
      }
    }
    checked.ExpectConsistent();
  }
  EXPECT_EQ(checked.store().size(), Limits::kMaxClusters);
  EXPECT_GT(checked.counters().clusters_evicted, 500U);
}

TEST(ClusterStore, RandomObservationsInFewNodes_KeepItConsistent) {
  using Limits = Pools<40, 64>;
  CheckedStore<Limits> checked;
  std::mt19937 random(2);
  for (std::uint32_t frame = 1; frame < 400; ++frame) {
    for (int i = 0; i < 4; ++i) {
      // Each needs six nodes at most, so that four in one frame always find room.
      EXPECT_NE(checked.Observe(RandomPlace(random, 8), frame), kNoHandle);
    }
    EXPECT_LE(checked.store().tree().used_nodes(), Limits::kMaxNodes);
    checked.ExpectConsistent();
  }
  EXPECT_GT(checked.counters().clusters_evicted, 200U);
  EXPECT_EQ(checked.counters().samples_refused, 0U);
}

TEST(ClusterStore, MoreThanFitsInOneFrame_IsRefusedAndCountedOnce) {
  CheckedStore<Pools<40, 64>> few_nodes;
  CheckedStore<Pools<512, 16>> few_clusters;
  std::mt19937 random(3);
  std::uint32_t refused = 0;
  for (int i = 0; i < 100; ++i) {
    const Place place = RandomPlace(random, 8);
    refused += few_nodes.Observe(place, 1) == kNoHandle ? 1U : 0U;
    refused += few_clusters.Observe(place, 1) == kNoHandle ? 1U : 0U;
  }
  EXPECT_GT(refused, 50U);
  EXPECT_EQ(few_nodes.counters().samples_refused + few_clusters.counters().samples_refused,
            refused);
  EXPECT_EQ(few_nodes.counters().clusters_evicted + few_clusters.counters().clusters_evicted, 0U);
  few_nodes.ExpectConsistent();
  few_clusters.ExpectConsistent();
}

/// Root and the six levels below it: one leaf.
constexpr int kNodesOfOneLeaf = 1 + Octree<8>::kDepth;

TEST(ClusterStore, LeafOfSeveralClusters_MakesRoomForAnother) {
  CheckedStore<Pools<kNodesOfOneLeaf, 16>> checked;
  for (int side = 0; side < 4; ++side)
    EXPECT_NE(checked.Observe({10, 10, 10, side}, static_cast<std::uint32_t>(side)), kNoHandle);
  EXPECT_NE(checked.Observe({50, 50, 50, 0}, 9), kNoHandle);
  EXPECT_EQ(checked.counters().clusters_evicted, 4U);
  EXPECT_EQ(checked.counters().samples_refused, 0U);
  checked.ExpectConsistent();
}

TEST(ClusterStore, LeafSeenInThisFrame_IsNotEmptiedInPart) {
  CheckedStore<Pools<kNodesOfOneLeaf, 16>> checked;
  EXPECT_NE(checked.Observe({10, 10, 10, 0}, 1), kNoHandle);
  EXPECT_NE(checked.Observe({10, 10, 10, 1}, 9), kNoHandle);
  EXPECT_EQ(checked.Observe({50, 50, 50, 0}, 9), kNoHandle);
  // Evicting the older side would have freed no node.
  EXPECT_TRUE(checked.Knows({10, 10, 10, 0}));
  EXPECT_EQ(checked.counters().clusters_evicted, 0U);
  checked.ExpectConsistent();
}

TEST(ClusterStore, OutOfBounds_IsCountedAndChangesNothing) {
  CheckedStore<Pools<64, 8>> checked;
  (void)checked.Observe({32, 32, 32, 0}, 1);
  ClusterStore<Pools<64, 8>>& store = checked.store();
  Counters counters;
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const float outside_m = 0.5F * kCell_m * 64.0F + 1e-4F;
  for (const Vec3& x_m : {Vec3(outside_m, 0.0F, 0.0F), Vec3(0.0F, -outside_m, 0.0F),
                          Vec3(0.0F, 0.0F, 1e30F), Vec3(kNan, 0.0F, 0.0F)}) {
    EXPECT_EQ(store.FindOrCreate(x_m, Side(0), 2, counters), kNoHandle);
  }
  EXPECT_EQ(counters.observations_out_of_bounds, 4U);
  EXPECT_EQ(counters.samples_refused, 0U);
  checked.ExpectConsistent();
}

TEST(ClusterStore, NearestCluster_IsThatOfTheNearestCentroidWhoseNormalAgrees) {
  CheckedStore<Pools<512, 40>> checked;
  std::mt19937 random(4);
  for (int i = 0; i < 30; ++i) (void)checked.Observe(RandomPlace(random, 3), 1);
  std::uniform_real_distribution<float> coordinate(-0.07F, 0.07F);
  constexpr float kReach_m = 0.03F;
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 x_m(coordinate(random), coordinate(random), coordinate(random));
    const Vec3 normal = Side(i % 6);
    const Handle nearest = checked.store().FindNearest(x_m, normal, kReach_m, 0.5F);
    float best_m = kReach_m;
    checked.store().ForEach([&](Handle, const auto& cluster) {
      if (cluster.mean_normal.dot(normal) > 0.5F)
        best_m = std::min(best_m, (cluster.centroid_m - x_m).norm());
    });
    if (nearest == kNoHandle) {
      EXPECT_EQ(best_m, kReach_m) << "there is one within reach";
      continue;
    }
    ++found;
    EXPECT_GT(checked.store()[nearest].mean_normal.dot(normal), 0.5F);
    if (best_m < kReach_m) {
      EXPECT_FLOAT_EQ((checked.store()[nearest].centroid_m - x_m).norm(), best_m);
    }
  }
  EXPECT_GT(found, 50);
}

TEST(ClusterStore, Restarted_IsEmpty) {
  CheckedStore<Pools<64, 8>> checked;
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i) (void)checked.Observe(RandomPlace(random, 2), 1);
  EXPECT_GT(checked.store().size(), 0);
  checked.store().Start(kCell_m, kCreaseCos);
  EXPECT_EQ(checked.store().size(), 0);
  EXPECT_EQ(checked.store().tree().used_nodes(), 1);
  checked.store().ForEach([](Handle, const auto&) { ADD_FAILURE(); });
}

}  // namespace
}  // namespace disflow::testing
