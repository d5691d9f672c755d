// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/model_drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "disflow/flow/normal_equations.h"
#include "disflow/flow/residual_sums_impl.h"

namespace disflow {
namespace {

constexpr float kLever_m = 0.1F;
constexpr PlacementScale kScale{.pixel_m = 1e-3F, .depth_noise_m = 2e-3F};

float Std(const Mat6& covariance, int i) { return std::sqrt(covariance(i, i)); }

// Known well today, and yet the model may be off.
TEST(Drift, GrowsWithThePiecesAndInAllDirections) {
  const Mat6 covariance = 1e-12F * Mat6::Identity();
  const RegistrationConfig config;
  EXPECT_EQ(WithDrift(covariance, 0.0F, kScale, kLever_m, config), covariance);
  Vec6 last = covariance.diagonal();
  for (const float pieces : {0.5F, 1.0F, 3.0F}) {
    const Mat6 drifted = WithDrift(covariance, pieces, kScale, kLever_m, config);
    EXPECT_GT((drifted.diagonal() - last).minCoeff(), 0.0F) << pieces;
    last = drifted.diagonal();
  }
}

TEST(Drift, OfOnePiece_IsAShareOfAPixelAndOfItsNoiseAtTheRadius) {
  RegistrationConfig config;
  config.drift_px = 0.4F;
  config.drift_tilt = 0.2F;
  const Mat6 drifted = WithDrift(Mat6::Zero(), 1.0F, kScale, kLever_m, config);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FLOAT_EQ(Std(drifted, i), 0.4e-3F);
    EXPECT_FLOAT_EQ(Std(drifted, 3 + i), 0.2F * 2e-3F / kLever_m);
  }
  // Of independent pieces variances add up.
  const Mat6 of_four = WithDrift(Mat6::Zero(), 4.0F, kScale, kLever_m, config);
  EXPECT_FLOAT_EQ(Std(of_four, 0), 2.0F * Std(drifted, 0));
}

TEST(Drift, WhatTheRegistrationKnowsBadly_StaysTheLargest) {
  Mat6 covariance = 1e-10F * Mat6::Identity();
  covariance(4, 4) = 0.04F;
  covariance(1, 4) = covariance(4, 1) = 1e-7F;
  const Mat6 drifted = WithDrift(covariance, 2.0F, kScale, kLever_m, {});
  EXPECT_GT(Std(drifted, 4), 0.2F);
  EXPECT_EQ(drifted, Mat6(drifted.transpose()));
  EXPECT_GE(drifted(1, 4), covariance(1, 4));
}

TEST(Lever, IsTheRootMeanSquareDistance_WhicheverWayTheGradientsPoint) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-0.1F, 0.1F);
  for (int round = 0; round < 20; ++round) {
    NormalSums sums;
    float weight = 0.0F;
    float moment_m2 = 0.0F;
    for (int i = 0; i < 50; ++i) {
      const Vec3 x_m(place(random), place(random), place(random));
      const Vec3 gradient = Vec3(place(random), place(random), place(random)).normalized();
      const float w = 1e4F * (0.2F + place(random));
      sums.Add(x_m, gradient, 0.0F, w);
      weight += w;
      moment_m2 += w * x_m.squaredNorm();
    }
    NormalEquations equations;
    equations += sums;
    const float lever_m = LeverOf({equations.h, equations.h, equations.Isotropic() - equations.h});
    EXPECT_NEAR(lever_m, std::sqrt(moment_m2 / weight), 1e-3F * lever_m);
  }
}

TEST(Lever, OfASinglePoint_IsNotZero) {
  NormalSums sums;
  sums.Add(Vec3::Zero(), Vec3::UnitZ(), 0.0F, 1.0F);
  NormalEquations equations;
  equations += sums;
  EXPECT_GT(LeverOf({equations.h, equations.Isotropic() - equations.h}), 0.0F);
}

}  // namespace
}  // namespace disflow
