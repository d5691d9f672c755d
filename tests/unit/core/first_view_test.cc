// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/first_view.h"

#include <gtest/gtest.h>

namespace disflow {
namespace {

constexpr float kOutline_m = 3e-4F;

Mat6 Stated(float position_std_m, float rotation_std_rad) {
  Vec6 variances;
  variances << Vec3::Constant(position_std_m * position_std_m),
      Vec3::Constant(rotation_std_rad * rotation_std_rad);
  return variances.asDiagonal();
}

TEST(FirstView, BeforeAnyOtherView_AddsNothing) {
  EXPECT_TRUE(FirstView().covariance_o().isZero(0.0F));
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
  const Mat6& left = first_view.covariance_o();
  const float outline_m2 = kOutline_m * kOutline_m;
  // Along the first view's rays the depth tells, across them the outline.
  EXPECT_FLOAT_EQ(left(2, 2), second(2, 2));
  EXPECT_FLOAT_EQ(left(0, 0), second(0, 0) + outline_m2);
  EXPECT_FLOAT_EQ(left(1, 1), second(1, 1) + outline_m2);
  EXPECT_FLOAT_EQ(left(4, 4), second(4, 4));
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
  const Mat6 unscaled = first_view.covariance_o();
  first_view.Learn(second, steady, 0.0F);
  EXPECT_LT(first_view.covariance_o()(2, 2), 0.5F * unscaled(2, 2));
  EXPECT_TRUE(first_view.covariance_o().isApprox(steady.Of(second)));
}

TEST(FirstView, OfANewObject_IsItsOwn) {
  FirstView first_view;
  first_view.Learn(Stated(1.0F, 1.0F), PoseNoise(), 1.0F);
  first_view.Start();
  EXPECT_TRUE(first_view.covariance_o().isZero(0.0F));
  first_view.Learn(Stated(2e-4F, 1e-3F), PoseNoise(), 0.0F);
  EXPECT_TRUE(first_view.covariance_o().isApprox(Stated(2e-4F, 1e-3F)));
}

}  // namespace
}  // namespace disflow
