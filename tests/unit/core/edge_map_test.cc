// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/edge_map.h"

#include <gtest/gtest.h>

#include <random>

namespace disflow::testing {
namespace {

constexpr int kCapacity = 8;
constexpr float kMerge_m = 0.004F;
using Map = EdgeMap<kCapacity>;

/// A point of an edge along x whose surface faces the camera.
EdgePoint PointAt(const Vec3& position_m, const Vec3& direction = Vec3::UnitX(),
                  const Vec3& normal = -Vec3::UnitZ()) {
  EdgePoint point;
  point.position_m = position_m;
  point.direction = direction.normalized();
  point.normal = normal.normalized();
  point.ray = Vec3::UnitZ();
  point.pixel_m = 1e-3F;
  return point;
}
EdgePoint PointAt(float x_m, float y_m = 0.0F) { return PointAt(Vec3(x_m, y_m, 0.5F)); }

class EdgeMapTest : public ::testing::Test {
 protected:
  EdgeMapTest() { map_.Start(); }
  void Insert(const EdgePoint& point) { map_.Insert(point, kMerge_m, counters_); }
  [[nodiscard]] const Map::Edge* Nearest(const EdgePoint& point, float radius_m = 1.0F) const {
    return map_.FindNearest(point, radius_m);
  }

  Map map_;
  Counters counters_;
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
  constexpr float kNoise_m = 5e-4F;
  constexpr int kCount = 2000;
  std::mt19937 random(1);
  std::normal_distribution<float> gaussian;
  for (int i = 0; i < kCount; ++i) {
    // Anywhere along the edge, which says nothing, and with the tangent's sign by chance.
    const Vec3 position_m(1e-3F * gaussian(random), 0.02F + kNoise_m * gaussian(random),
                          0.5F + kNoise_m * gaussian(random));
    const Vec3 direction(i % 2 == 0 ? 1.0F : -1.0F, 0.05F * gaussian(random),
                         0.05F * gaussian(random));
    Insert(PointAt(position_m, direction));
  }
  ASSERT_EQ(map_.size(), 1);
  const Map::Edge& edge = *Nearest(PointAt(0.0F, 0.02F));
  // The weight is bounded: the mean of about the last forty.
  const float allowed_m = 4.0F * kNoise_m / std::sqrt(40.0F);
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

TEST_F(EdgeMapTest, OldEdge_StillFollowsWhereItIsSeen) {
  for (int i = 0; i < 1000; ++i) Insert(PointAt(0.0F, 0.0F));
  for (int i = 0; i < 100; ++i) Insert(PointAt(0.0F, 0.001F));
  ASSERT_EQ(map_.size(), 1);
  EXPECT_NEAR(Nearest(PointAt(0.0F))->position_m.y(), 0.001F, 5e-5F);
}

TEST_F(EdgeMapTest, OtherDirectionOrSide_IsAnotherEdge) {
  Insert(PointAt(0.0F));
  const EdgePoint across = PointAt(Vec3(0.0F, 0.0F, 0.5F), Vec3::UnitY());
  const EdgePoint other_side = PointAt(Vec3(0.0F, 0.0F, 0.5F), Vec3::UnitX(), Vec3::UnitY());
  EXPECT_EQ(Nearest(across), nullptr);
  EXPECT_EQ(Nearest(other_side), nullptr);
  Insert(across);
  Insert(other_side);
  EXPECT_EQ(map_.size(), 3);
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

TEST_F(EdgeMapTest, FullMap_RefusesNewEdgesAndCountsThem) {
  for (int i = 0; i < kCapacity + 5; ++i) Insert(PointAt(0.01F * static_cast<float>(i)));
  EXPECT_EQ(map_.size(), kCapacity);
  EXPECT_EQ(counters_.edges_refused, 5U);
  // Those that are known can still be averaged into.
  Insert(PointAt(0.0F, 0.002F));
  EXPECT_EQ(counters_.edges_refused, 5U);
  EXPECT_NEAR(Nearest(PointAt(0.0F))->position_m.y(), 0.001F, 1e-6F);
  map_.Start();
  EXPECT_EQ(map_.size(), 0);
}

TEST_F(EdgeMapTest, PointThatIsNotFinite_MovesNoEdge) {
  Insert(PointAt(0.0F));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(Nearest(PointAt(Vec3(nan, 0.0F, 0.5F))), nullptr);
  EXPECT_EQ(Nearest(PointAt(0.0F, 0.0F), nan), nullptr);
}

}  // namespace
}  // namespace disflow::testing
