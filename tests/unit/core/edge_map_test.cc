// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/edge_map.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "disflow/field/edge_index.h"

namespace disflow::testing {
namespace {

constexpr int kCapacity = 8;
constexpr float kMerge_m = 0.004F;
constexpr float kStd_m = 5e-4F;
using Map = EdgeMap<kCapacity>;

/// A point of an edge along x whose surface faces the camera.
EdgePoint PointAt(const Vec3& position_m, const Vec3& direction = Vec3::UnitX(),
                  const Vec3& normal = -Vec3::UnitZ()) {
  EdgePoint point;
  point.position_m = position_m;
  point.direction = direction.normalized();
  point.normal = normal.normalized();
  point.ray = Vec3::UnitZ();
  point.outward = point.ray.cross(point.direction).normalized();
  point.variance_m2 = kStd_m * kStd_m;
  return point;
}
EdgePoint PointAt(float x_m, float y_m = 0.0F) { return PointAt(Vec3(x_m, y_m, 0.5F)); }

class EdgeMapTest : public ::testing::Test {
 protected:
  EdgeMapTest() { map_.Start(); }
  void Insert(const EdgePoint& point) { map_.Insert(point, kMerge_m, frame_, counters_); }
  [[nodiscard]] const Map::Edge* Nearest(const EdgePoint& point, float radius_m = 1.0F) const {
    const int nearest = FindNearestEdge(map_.all(), point, radius_m);
    return nearest < 0 ? nullptr : &map_.all()[static_cast<std::size_t>(nearest)];
  }

  Map map_;
  Counters counters_;
  std::uint32_t frame_ = 0;
};

TEST_F(EdgeMapTest, EmptyMap_HasNoNearestEdge) {
  EXPECT_EQ(map_.size(), 0);
  EXPECT_EQ(Nearest(PointAt(0.0F)), nullptr);
}

TEST_F(EdgeMapTest, PointsFarApart_AreKeptApart) {
  Insert(PointAt(0.0F));
  Insert(PointAt(1.01F * kMerge_m));
  EXPECT_EQ(map_.size(), 2);
  EXPECT_EQ(counters_.edges_refused, 0U);
}

TEST_F(EdgeMapTest, PointsCloseToEachOther_AreOneEdge) {
  Insert(PointAt(0.0F));
  Insert(PointAt(0.99F * kMerge_m));
  EXPECT_EQ(map_.size(), 1);
}

TEST_F(EdgeMapTest, ManyNoisyPoints_AverageToTheTrueEdge) {
  constexpr int kCount = 2000;
  std::mt19937 random(1);
  std::normal_distribution<float> gaussian;
  for (int i = 0; i < kCount; ++i) {
    // Anywhere along the edge, which says nothing, and with the tangent's sign by chance.
    const Vec3 position_m(1e-3F * gaussian(random), 0.02F + kStd_m * gaussian(random),
                          0.5F + kStd_m * gaussian(random));
    const Vec3 direction(i % 2 == 0 ? 1.0F : -1.0F, 0.05F * gaussian(random),
                         0.05F * gaussian(random));
    Insert(PointAt(position_m, direction));
  }
  ASSERT_EQ(map_.size(), 1);
  const Map::Edge& edge = *Nearest(PointAt(0.0F, 0.02F));
  // The weight is bounded: the mean of about the last forty.
  const float allowed_m = 4.0F * kStd_m / std::sqrt(40.0F);
  EXPECT_NEAR(edge.position_m.y(), 0.02F, allowed_m);
  EXPECT_NEAR(edge.position_m.z(), 0.5F, allowed_m);
  EXPECT_GT(std::abs(edge.direction.x()), 0.999F);
  EXPECT_NEAR(edge.direction.norm(), 1.0F, 1e-5F);
  EXPECT_NEAR(edge.normal.norm(), 1.0F, 1e-5F);
}

TEST_F(EdgeMapTest, PointFartherAlongTheEdge_DoesNotMoveIt) {
  Insert(PointAt(0.0F));
  Insert(PointAt(0.003F));
  EXPECT_EQ(Nearest(PointAt(0.0F))->position_m, Vec3(0.0F, 0.0F, 0.5F));
}

TEST_F(EdgeMapTest, PointThatIsNotSteady_ChangesNothing) {
  EdgePoint doubtful = PointAt(0.001F);
  doubtful.steady = false;
  Insert(doubtful);
  EXPECT_EQ(map_.size(), 0);
  Insert(PointAt(0.0F));
  Insert(doubtful);
  ASSERT_EQ(map_.size(), 1);
  EXPECT_EQ(Nearest(PointAt(0.0F))->weight, 1.0F);
}

TEST_F(EdgeMapTest, PointThatIsNotSteady_FindsWellKnownEdgesOnly) {
  EdgePoint doubtful = PointAt(0.0F);
  doubtful.steady = false;
  for (float weight = 1.0F; weight < kWellKnownWeight; weight += 1.0F) {
    Insert(PointAt(0.0F));
    ASSERT_EQ(Nearest(PointAt(0.0F))->weight, weight);
    EXPECT_EQ(Nearest(doubtful), nullptr);
  }
  Insert(PointAt(0.0F));
  EXPECT_NE(Nearest(doubtful), nullptr);
  // A nearer one that was seen once is passed over.
  doubtful.position_m.y() = 2.0F * kMerge_m;
  Insert(PointAt(0.0F, 2.0F * kMerge_m));
  ASSERT_EQ(map_.size(), 2);
  EXPECT_EQ(Nearest(doubtful)->weight, kWellKnownWeight);
}

TEST_F(EdgeMapTest, OldEdge_StillFollowsWhereItIsSeen) {
  for (int i = 0; i < 1000; ++i) Insert(PointAt(0.0F, 0.0F));
  for (int i = 0; i < 100; ++i) Insert(PointAt(0.0F, 0.001F));
  ASSERT_EQ(map_.size(), 1);
  EXPECT_NEAR(Nearest(PointAt(0.0F))->position_m.y(), 0.001F, 5e-5F);
}

TEST_F(EdgeMapTest, OtherDirection_IsAnotherEdge) {
  Insert(PointAt(0.0F));
  const EdgePoint across = PointAt(Vec3(0.0F, 0.0F, 0.5F), Vec3::UnitY());
  EXPECT_EQ(Nearest(across), nullptr);
  Insert(across);
  EXPECT_EQ(map_.size(), 2);
}

TEST_F(EdgeMapTest, OtherFaceThatMeetsAtTheEdge_EndsAtTheSameEdge) {
  Insert(PointAt(0.0F));
  const EdgePoint other_face = PointAt(Vec3(0.0F, 0.0F, 0.5F), Vec3::UnitX(), Vec3::UnitY());
  EXPECT_NE(Nearest(other_face), nullptr);
  Insert(other_face);
  EXPECT_EQ(map_.size(), 1);
}

TEST_F(EdgeMapTest, FaceThatPassesTheEdge_EndsElsewhere) {
  Insert(PointAt(0.0F));
  // Its plane, or that of the edge's face, lies a centimetre off the other's end.
  for (const Vec3& off_m : {Vec3(0.0F, 0.01F, 0.0F), Vec3(0.0F, 0.0F, 0.01F)}) {
    const EdgePoint passing = PointAt(Vec3(0.0F, 0.0F, 0.5F) + off_m, Vec3::UnitX(), Vec3::UnitY());
    EXPECT_EQ(FindNearestEdge(map_.all(), passing, 0.02F), -1);
  }
}

TEST_F(EdgeMapTest, NearestEdge_IsTheNearestOfThoseInReach) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(-0.1F, 0.1F);
  std::array<EdgePoint, kCapacity> points;
  for (EdgePoint& point : points) {
    point = PointAt(Vec3(uniform(random), uniform(random), uniform(random)));
    Insert(point);
  }
  ASSERT_EQ(map_.size(), kCapacity);
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const EdgePoint asked = PointAt(Vec3(uniform(random), uniform(random), uniform(random)));
    constexpr float kReach_m = 0.06F;
    float nearest_m = kReach_m;
    for (const EdgePoint& point : points)
      nearest_m = std::min(nearest_m, (point.position_m - asked.position_m).norm());
    const Map::Edge* edge = Nearest(asked, kReach_m);
    ASSERT_EQ(edge != nullptr, nearest_m < kReach_m);
    if (edge == nullptr) continue;
    ++found;
    EXPECT_FLOAT_EQ((edge->position_m - asked.position_m).norm(), nearest_m);
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(found, 490);
}

TEST(EdgeIndex, FindsWhatIsFoundWithoutIt) {
  constexpr int kMany = 200;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-0.1F, 0.1F);
  // Along any axis, and all in one place.
  for (const Vec3& extent :
       {Vec3(1.0F, 0.2F, 0.2F), Vec3(0.1F, 0.2F, 1.0F), Vec3(0.0F, 0.0F, 0.0F)}) {
    const auto place = [&] {
      return Vec3(extent.cwiseProduct(Vec3(uniform(random), uniform(random), uniform(random))));
    };
    std::vector<ModelEdge> edges;
    for (int i = 0; i < kMany; ++i) {
      edges.push_back(
          MakeModelEdge(PointAt(place(), i % 2 == 0 ? Vec3::UnitX() : Vec3::UnitY()), 1));
      edges.back().weight = static_cast<float>(i % 20);
    }
    EdgeIndex<kMany> index;
    index.Build(edges);
    for (int i = 0; i < 500; ++i) {
      EdgePoint asked = PointAt(Vec3(1.2F * place()));
      asked.steady = i % 3 != 0;
      for (const float radius_m : {0.003F, 0.02F, 0.5F}) {
        const int nearest = FindNearestEdge(edges, asked, radius_m);
        const ModelEdge* const found = index.FindNearest(asked, radius_m);
        ASSERT_EQ(found != nullptr, nearest >= 0) << i;
        if (found == nullptr) continue;
        const Vec3 expected_m = edges[static_cast<std::size_t>(nearest)].position_m;
        ASSERT_EQ((found->position_m - asked.position_m).norm(),
                  (expected_m - asked.position_m).norm());
      }
    }
  }
}

TEST(EdgeIndex, EmptyMap_HasNoNearestEdge) {
  EdgeIndex<kCapacity> index;
  index.Build({});
  EXPECT_EQ(index.FindNearest(PointAt(0.0F), 1.0F), nullptr);
}

TEST_F(EdgeMapTest, DepthThatIsHardlyKnown_ComesFromAnotherView) {
  EdgePoint point = PointAt(0.0F);
  point.depth_variance_m2 = 0.01F * 0.01F;
  Insert(point);
  const Map::Edge& edge = *Nearest(point);
  EXPECT_NEAR(std::sqrt(edge.VarianceAlong(Vec3::UnitY())), kStd_m, 1e-5F);
  EXPECT_NEAR(std::sqrt(edge.VarianceAlong(Vec3::UnitZ())), 0.01F, 1e-4F);
  // From the side, the edge is seen to be 3 mm nearer than it was taken to be.
  point.position_m.z() -= 0.003F;
  point.ray = Vec3::UnitY();
  point.outward = -Vec3::UnitZ();
  point.normal = Vec3(0.0F, -0.5F, -1.0F).normalized();
  Insert(point);
  ASSERT_EQ(map_.size(), 1);
  EXPECT_NEAR(edge.position_m.z(), 0.5F - 0.003F, 2e-5F);
  EXPECT_LT(std::abs(edge.position_m.y()), 1e-5F);
  EXPECT_LT(std::sqrt(edge.VarianceAlong(Vec3::UnitZ())), 1.01F * kStd_m);
}

TEST_F(EdgeMapTest, PointWithUncertainDepth_IsFoundFartherOff) {
  Insert(PointAt(0.0F));
  EdgePoint behind = PointAt(Vec3(0.0F, 0.0F, 0.51F));
  Insert(behind);
  EXPECT_EQ(map_.size(), 2);
  map_.Start();
  Insert(PointAt(0.0F));
  behind.depth_variance_m2 = 0.005F * 0.005F;
  Insert(behind);
  EXPECT_EQ(map_.size(), 1);
}

/// A series of edges far from each other.
EdgePoint Nth(int i) { return PointAt(0.01F * static_cast<float>(i)); }

TEST_F(EdgeMapTest, FullMap_ForgetsWhatWasSeenOnceFirst) {
  for (int i = 0; i < kCapacity; ++i) Insert(Nth(i));
  // The first half is seen again and again, though not lately.
  for (frame_ = 1; frame_ < 4; ++frame_) {
    for (int i = 0; i < kCapacity / 2; ++i) Insert(Nth(i));
  }
  constexpr int kMore = 100;
  for (int i = kCapacity; i < kCapacity + kMore; ++i) {
    ++frame_;
    Insert(Nth(i));
  }
  EXPECT_EQ(map_.size(), kCapacity);
  EXPECT_EQ(counters_.edges_refused, 0U);
  for (int i = 0; i < kCapacity / 2; ++i) EXPECT_NE(Nearest(Nth(i), 0.001F), nullptr) << i;
  for (int i = kCapacity + kMore - kCapacity / 2; i < kCapacity + kMore; ++i)
    EXPECT_NE(Nearest(Nth(i), 0.001F), nullptr) << "the newest";
}

TEST_F(EdgeMapTest, MapFullOfKnownEdges_ForgetsWhatWasNotSeenForTheLongestTime) {
  for (frame_ = 0; frame_ < 5; ++frame_) {
    for (int i = 0; i < kCapacity; ++i) Insert(Nth(i));
  }
  for (int i = 0; i < kCapacity; ++i) {
    ++frame_;
    if (i != 3) Insert(Nth(i));
  }
  ++frame_;
  Insert(Nth(50));
  EXPECT_EQ(counters_.edges_refused, 0U);
  EXPECT_EQ(Nearest(Nth(3), 0.001F), nullptr);
  for (const int i : {0, 1, 2, 4, 5, 6, 7, 50}) EXPECT_NE(Nearest(Nth(i), 0.001F), nullptr) << i;
}

TEST_F(EdgeMapTest, MapFullOfThisFramesEdges_RefusesNewOnesAndCountsThem) {
  for (int i = 0; i < kCapacity + 5; ++i) Insert(Nth(i));
  EXPECT_EQ(map_.size(), kCapacity);
  EXPECT_EQ(counters_.edges_refused, 5U);
  // Those that are known can still be fused with.
  Insert(PointAt(0.0F, 0.002F));
  EXPECT_EQ(counters_.edges_refused, 5U);
  EXPECT_NEAR(Nearest(PointAt(0.0F))->position_m.y(), 0.001F, 1e-5F);
  map_.Start();
  EXPECT_EQ(map_.size(), 0);
}

TEST_F(EdgeMapTest, PointThatIsNotFinite_MovesNoEdge) {
  Insert(PointAt(0.0F));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(Nearest(PointAt(Vec3(nan, 0.0F, 0.5F))), nullptr);
  EXPECT_EQ(Nearest(PointAt(0.0F, 0.0F), nan), nullptr);
}

TEST_F(EdgeMapTest, EdgesFoundWhileTheObjectMayHaveSlid_AreNotKnown_AndCanBeForgotten) {
  Insert(PointAt(0.0F));
  map_.SetShiftFree(true);
  Insert(PointAt(0.1F));
  map_.SetShiftFree(true);
  Insert(PointAt(0.2F));
  EXPECT_EQ(map_.size(), 3);
  ASSERT_EQ(map_.known().size(), 1U);
  EXPECT_NEAR(map_.known()[0].position_m.x(), 0.0F, 1e-6F);
  map_.ForgetFoundShiftFree();
  EXPECT_EQ(map_.size(), 1);
}

TEST_F(EdgeMapTest, EdgesFoundWhileTheObjectMayHaveSlid_AreKnownOnceItHasNot) {
  map_.SetShiftFree(true);
  Insert(PointAt(0.1F));
  EXPECT_EQ(map_.known().size(), 0U);
  map_.SetShiftFree(false);
  EXPECT_EQ(map_.known().size(), 1U);
  map_.ForgetFoundShiftFree();
  EXPECT_EQ(map_.size(), 1);
}

TEST_F(EdgeMapTest, FullMap_KeepsWhatWasKnownWhileTheObjectMayHaveSlid) {
  for (int i = 0; i < kCapacity - 1; ++i) Insert(PointAt(0.1F * static_cast<float>(i)));
  map_.SetShiftFree(true);
  for (int i = 0; i < 3; ++i) {
    ++frame_;
    Insert(PointAt(1.0F + 0.1F * static_cast<float>(i)));
  }
  ASSERT_EQ(map_.known().size(), static_cast<std::size_t>(kCapacity - 1));
  for (int i = 0; i < kCapacity - 1; ++i) {
    EXPECT_NEAR(map_.known()[static_cast<std::size_t>(i)].position_m.x(),
                0.1F * static_cast<float>(i), 1e-6F);
  }
  // The newest of the others is there.
  EXPECT_NEAR(map_.all().back().position_m.x(), 1.2F, 1e-6F);
}

}  // namespace
}  // namespace disflow::testing
