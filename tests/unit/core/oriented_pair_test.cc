// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/oriented_pair.h"

#include <gtest/gtest.h>

#include <random>

namespace disflow {
namespace {

constexpr float kCosineTolerance = 0.1F;

class OrientedPairs : public ::testing::Test {
 protected:
  Vec3 Any() {
    std::normal_distribution<float> gaussian;
    const float x = gaussian(random_);
    const float y = gaussian(random_);
    return {x, y, gaussian(random_)};
  }
  OrientedPair AnyPair() {
    const Vec3 a_m = Any();
    const Vec3 normal_a = Any().normalized();
    const Vec3 b_m = Any();
    return {a_m, normal_a, b_m, Any().normalized()};
  }
  PoseObjectFromCamera AnyPose() {
    const Mat3 turn = ExpSo3(Any());
    return {turn, Any()};
  }
  static OrientedPair Moved(const PoseObjectFromCamera& T_oc, const OrientedPair& pair) {
    return {T_oc * pair.a_m, T_oc.rotation() * pair.normal_a, T_oc * pair.b_m,
            T_oc.rotation() * pair.normal_b};
  }

 private:
  std::mt19937 random_{5};
};

TEST_F(OrientedPairs, PairFromElsewhere_IsLikeItself_AndTellsThePose) {
  for (int i = 0; i < 1000; ++i) {
    const PoseObjectFromCamera T_oc = AnyPose();
    const OrientedPair seen = AnyPair();
    const OrientedPair known = Moved(T_oc, seen);
    ASSERT_TRUE(seen.IsAsFar((known.b_m - known.a_m).squaredNorm(), 1e-4F));
    ASSERT_TRUE(seen.IsLike(known, kCosineTolerance));
    const PoseObjectFromCamera found = seen.LaidOnto(known);
    ASSERT_LT(TurnBetween(T_oc.rotation(), found.rotation()).norm(), 2e-2F) << i;
    ASSERT_LT((found * seen.a_m - known.a_m).norm(), 1e-4F) << i;
    ASSERT_LT((found * seen.b_m - known.b_m).norm(), 1e-4F) << i;
  }
}

TEST_F(OrientedPairs, FartherOrNearerByMoreThanTheTolerance_IsNotAsFar) {
  const OrientedPair pair(Vec3::Zero(), Vec3::UnitZ(), Vec3(0.1F, 0.0F, 0.0F), Vec3::UnitZ());
  for (const float off_m : {-0.011F, 0.011F}) {
    EXPECT_FALSE(pair.IsAsFar((0.1F + off_m) * (0.1F + off_m), 0.01F));
    EXPECT_TRUE(pair.IsAsFar((0.1F + 0.8F * off_m) * (0.1F + 0.8F * off_m), 0.01F));
  }
  EXPECT_TRUE(pair.IsAsFar(0.0F, 0.2F));
}

TEST_F(OrientedPairs, AnyOfTheNormalsTurned_IsAnotherPair) {
  const Mat3 turn = ExpSo3(Vec3(0.0F, 0.3F, 0.0F));
  const Vec3 a_m = Vec3::Zero();
  const Vec3 b_m(0.1F, 0.0F, 0.0F);
  const Vec3 up = Vec3::UnitZ();
  const OrientedPair pair(a_m, up, b_m, up);
  EXPECT_TRUE(pair.IsLike(pair, kCosineTolerance));
  EXPECT_FALSE(pair.IsLike({a_m, turn * up, b_m, up}, kCosineTolerance));
  EXPECT_FALSE(pair.IsLike({a_m, up, b_m, turn * up}, kCosineTolerance));
  // The angle between the normals tells these apart, which stand alike to the line.
  const Mat3 about_line = ExpSo3(Vec3(0.6F, 0.0F, 0.0F));
  EXPECT_FALSE(pair.IsLike({a_m, up, b_m, about_line * up}, kCosineTolerance));
}

// Which of its points is the first matters.
TEST_F(OrientedPairs, PairTheOtherWayRound_IsAnother) {
  const OrientedPair seen(Vec3::Zero(), Vec3::UnitZ(), Vec3(0.1F, 0.0F, 0.0F), Vec3::UnitX());
  const OrientedPair known(seen.b_m, seen.normal_b, seen.a_m, seen.normal_a);
  EXPECT_FALSE(seen.IsLike(known, kCosineTolerance));
}

TEST_F(OrientedPairs, NormalsThatLeaveTheTurnOpen_StillGiveARotation) {
  const Vec3 b_m(0.1F, 0.0F, 0.0F);
  const OrientedPair along(Vec3::Zero(), Vec3::UnitX(), b_m, Vec3::UnitX());
  const OrientedPair against(Vec3::Zero(), Vec3::UnitX(), b_m, -Vec3::UnitX());
  for (const OrientedPair& pair : {along, against}) {
    const PoseObjectFromCamera T_oc = AnyPose();
    const PoseObjectFromCamera found = pair.LaidOnto(Moved(T_oc, pair));
    EXPECT_LT((found.rotation() * found.rotation().transpose() - Mat3::Identity()).norm(), 1e-5F);
    EXPECT_LT((found * pair.b_m - T_oc * pair.b_m).norm(), 1e-5F);
  }
}

}  // namespace
}  // namespace disflow
