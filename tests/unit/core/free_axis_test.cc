// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/free_axis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace disflow {
namespace {

constexpr float kRate_rps = 3.0F;

/// A turn about an axis through a point.
Mat6 TurnAbout(const Vec3& axis, const Vec3& point_m) {
  const Vec3 turn = kRate_rps * axis.normalized();
  Vec6 motion;
  motion << -turn.cross(point_m), turn;
  return motion * motion.transpose();
}

Vec3 AxisOf(const Mat6& free_turn) {
  Vec3 axis = Vec3::UnitZ();
  for (int i = 0; i < 50; ++i) axis = (free_turn.bottomRightCorner<3, 3>() * axis).normalized();
  return axis;
}

TEST(FreeAxis, IsTheMeanOfWhatFramesSay_AndKnowsHowTheyDiffer) {
  std::mt19937 random(2);
  constexpr float kOff_rad = 0.03F;
  std::normal_distribution<float> off(0.0F, kOff_rad);
  FreeAxis axis;
  Mat6 by_frame;
  for (int i = 0; i < 30; ++i) {
    by_frame = TurnAbout(Vec3(off(random), off(random), 1.0F), Vec3(0.01F, 0.0F, 0.0F));
    axis.Learn(by_frame);
  }
  const Mat6 known = axis.Steadied(by_frame);
  EXPECT_LT((AxisOf(known) - Vec3::UnitZ()).norm(), 2.5F * kOff_rad / std::sqrt(30.0F));
  for (int i = 3; i < 5; ++i)
    EXPECT_NEAR(std::sqrt(known(i, i)) / kRate_rps, kOff_rad, 0.5F * kOff_rad) << i;
}

TEST(FreeAxis, AnotherAxis_TakesItsPlaceAtOnce) {
  FreeAxis axis;
  for (int i = 0; i < 30; ++i) axis.Learn(TurnAbout(Vec3::UnitZ(), Vec3::Zero()));
  const Mat6 other = TurnAbout(Vec3::UnitX(), Vec3::Zero());
  EXPECT_EQ(axis.Steadied(other), other);
  axis.Learn(other);
  EXPECT_EQ(axis.Steadied(other), other);
  axis.Forget();
  const Mat6 upright = TurnAbout(Vec3::UnitZ(), Vec3::Zero());
  EXPECT_EQ(axis.Steadied(upright), upright);
}

TEST(FreeAxis, IsOne_OnceTenFramesAgreeAndThisOneDoes) {
  FreeAxis axis;
  const Mat6 upright = TurnAbout(Vec3::UnitZ(), Vec3(0.0F, 0.02F, 0.0F));
  for (int i = 0; i < 9; ++i) axis.Learn(upright);
  EXPECT_FALSE(axis.IsOne(upright));
  axis.Learn(upright);
  EXPECT_TRUE(axis.IsOne(upright));
  EXPECT_FALSE(axis.IsOne(TurnAbout(Vec3::UnitX(), Vec3::Zero())));
}

TEST(FreeAxis, SeenLikeABall_StaysKnown) {
  FreeAxis axis;
  const Mat6 upright = TurnAbout(Vec3::UnitZ(), Vec3::Zero());
  const Mat6 ball = upright + TurnAbout(Vec3::UnitX(), Vec3::Zero());
  EXPECT_FALSE(axis.Leaves(upright));
  for (int i = 0; i < 10; ++i) axis.Learn(upright);
  for (int i = 0; i < 30; ++i) axis.Learn(ball);
  EXPECT_TRUE(axis.Leaves(ball));
  EXPECT_FALSE(axis.IsOne(ball));
  EXPECT_TRUE(axis.IsOne(upright));
  EXPECT_TRUE(axis.Leaves(0.5F * upright));
  EXPECT_FALSE(axis.Leaves(TurnAbout(Vec3::UnitX(), Vec3::Zero())));
  EXPECT_FALSE(axis.Leaves(Mat6::Zero()));
}

TEST(FreeAxis, OfABall_IsNeverOne) {
  FreeAxis axis;
  const Mat6 ball = TurnAbout(Vec3::UnitZ(), Vec3::Zero()) + TurnAbout(Vec3::UnitX(), Vec3::Zero());
  for (int i = 0; i < 30; ++i) axis.Learn(ball);
  EXPECT_FALSE(axis.IsOne(ball));
}

TEST(FreeAxis, FrameThatTellsNothing_ChangesNothing) {
  FreeAxis axis;
  const Mat6 turn = TurnAbout(Vec3::UnitZ(), Vec3(0.0F, 0.02F, 0.0F));
  for (int i = 0; i < 10; ++i) axis.Learn(turn);
  axis.Learn(Mat6::Zero());
  axis.Learn(Mat6::Constant(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_TRUE(axis.Steadied(turn).isApprox(turn, 1e-5F));
  EXPECT_EQ(axis.Steadied(Mat6::Zero()), Mat6::Zero());
}

}  // namespace
}  // namespace disflow
