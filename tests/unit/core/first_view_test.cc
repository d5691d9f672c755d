// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/first_view.h"

#include <gtest/gtest.h>

#include <numbers>

namespace disflow {
namespace {

constexpr float kOutline_m = 3e-4F;

Mat6 Stated(float position_std_m, float rotation_std_rad) {
  Vec6 variances;
  variances << Vec3::Constant(position_std_m * position_std_m),
      Vec3::Constant(rotation_std_rad * rotation_std_rad);
  return variances.asDiagonal();
}

/// What it leaves of a pose that is as the first one, with outlines as far off as they were.
Mat6 LeftOfTheSameView(const FirstView& first_view, float outline_m) {
  return first_view.Covariance(Mat3::Identity(), outline_m);
}

Mat3 Turned(float angle_rad, const Vec3& axis) {
  return Eigen::AngleAxisf(angle_rad, axis).toRotationMatrix();
}

TEST(FirstView, BeforeAnyOtherView_AddsNothing) {
  EXPECT_TRUE(FirstView().Covariance(Turned(1.0F, Vec3::UnitX()), kOutline_m).isZero(0.0F));
}

// Nearer views are surer of the same surface, but the object frame is the first view's.
TEST(FirstView, WhatItLeftUncertain_StaysHoweverSharpLaterViewsAre) {
  FirstView first_view;
  const PoseNoise noise;
  const Mat6 second = Stated(2e-4F, 1e-3F);
  constexpr int kFirstFrames = 15;
  first_view.Learn(second, noise, kOutline_m);
  for (int i = 1; i < 100; ++i) {
    const float nearer = i < kFirstFrames ? 1.0F : 0.1F;
    first_view.Learn(Stated(1e-5F, 5e-5F), noise, nearer * kOutline_m);
  }
  const Mat6 left = LeftOfTheSameView(first_view, kOutline_m);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(left(i, i), second(i, i), 1e-3F * second(i, i));
}

/// Whose first view leaves what outlines are off by, and nothing else.
FirstView OfOutlinesAlone() {
  FirstView first_view;
  first_view.Learn(Mat6::Zero(), PoseNoise(), kOutline_m);
  return first_view;
}

// They are off by the same in the same view, wherever the object is.
TEST(FirstView, OutlinesOfTheSameView_LeaveNothing) {
  EXPECT_TRUE(LeftOfTheSameView(OfOutlinesAlone(), kOutline_m).isZero(1e-12F));
}

TEST(FirstView, OutlinesThatAreSharperNow_LeaveWhatTheyWereOffMore) {
  const Mat6 left = LeftOfTheSameView(OfOutlinesAlone(), 0.25F * kOutline_m);
  const float more_m = 0.75F * kOutline_m;
  EXPECT_FLOAT_EQ(left(0, 0), more_m * more_m);
  EXPECT_FLOAT_EQ(left(1, 1), more_m * more_m);
  EXPECT_EQ(left(2, 2), 0.0F);
}

// Along a view's rays the depth tells, across them the outline.
TEST(FirstView, OutlinesOfAViewAQuarterTurnAway_AddUpAcrossEachViewsRays) {
  const Mat3 R_co = Turned(0.5F * std::numbers::pi_v<float>, Vec3::UnitX());
  const Mat6 left = OfOutlinesAlone().Covariance(R_co, kOutline_m);
  const float outline_m2 = kOutline_m * kOutline_m;
  EXPECT_NEAR(left(0, 0), 2.0F * outline_m2, 1e-3F * outline_m2);
  EXPECT_NEAR(left(1, 1), outline_m2, 1e-3F * outline_m2);
  EXPECT_NEAR(left(2, 2), outline_m2, 1e-3F * outline_m2);
  EXPECT_TRUE((left.bottomRightCorner<3, 3>().isZero(0.0F)));
}

TEST(FirstView, TheFurtherTheObjectTurned_TheMoreItsOutlinesLeave) {
  const FirstView first_view = OfOutlinesAlone();
  float before_m2 = -1.0F;
  for (int i = 0; i <= 20; ++i) {
    const Mat3 R_co = Turned(0.15F * static_cast<float>(i), Vec3(1.0F, 2.0F, 2.0F) / 3.0F);
    const float left_m2 = first_view.Covariance(R_co, kOutline_m).trace();
    EXPECT_GE(left_m2, before_m2 - 1e-12F) << i;
    before_m2 = left_m2;
  }
  EXPECT_NEAR(before_m2, 4.0F * kOutline_m * kOutline_m, 1e-10F);  // two of each view
}

/// Poses that are steadier than their registration says.
PoseNoise Steady() {
  PoseNoise noise;
  for (int i = 0; i < 60; ++i) {
    const PoseCameraFromObject T_co(Mat3::Identity(), Vec3(0.0F, 0.0F, 0.5F));
    noise.Learn(33'333'333 * StampNs{i + 1}, T_co, Vec3::Zero(), Stated(2e-4F, 1e-3F), {});
  }
  return noise;
}

TEST(FirstView, OfPosesThatAreSteadierThanStated_LeavesAsMuchLessUncertain) {
  const Mat6 second = Stated(2e-4F, 1e-3F);
  const PoseNoise steady = Steady();
  FirstView first_view;
  first_view.Learn(second, PoseNoise(), 0.0F);
  const Mat6 unscaled = LeftOfTheSameView(first_view, 0.0F);
  first_view.Learn(second, steady, 0.0F);
  const Mat6 scaled = LeftOfTheSameView(first_view, 0.0F);
  EXPECT_LT(scaled(2, 2), 0.5F * unscaled(2, 2));
  EXPECT_TRUE(scaled.isApprox(steady.Of(second)));
}

TEST(FirstView, OfANewObject_IsItsOwn) {
  FirstView first_view;
  first_view.Learn(Stated(1.0F, 1.0F), PoseNoise(), 1.0F);
  first_view.Start();
  EXPECT_TRUE(LeftOfTheSameView(first_view, 1.0F).isZero(0.0F));
  first_view.Learn(Stated(2e-4F, 1e-3F), PoseNoise(), 0.0F);
  EXPECT_TRUE(LeftOfTheSameView(first_view, 0.0F).isApprox(Stated(2e-4F, 1e-3F)));
}

}  // namespace
}  // namespace disflow
