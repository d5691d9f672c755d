// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/model_drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "disflow/flow/normal_equations.h"
#include "disflow/flow/residual_sums_impl.h"

namespace disflow {
namespace {

constexpr float kOutline_m = 4e-4F;
constexpr float kLever_m = 0.1F;

PlacementScale Pieces(float pieces) {
  return {.pieces = pieces, .outline_m = kOutline_m, .lever_m = kLever_m};
}

float Std(const Mat6& covariance, int i) { return std::sqrt(covariance(i, i)); }

// Known well today, and yet the model may be off.
TEST(Drift, GrowsWithThePiecesAndInAllDirections) {
  const Mat6 covariance = 1e-12F * Mat6::Identity();
  const RegistrationConfig config;
  EXPECT_TRUE(DriftOf(covariance, Pieces(0.0F), config).isZero(0.0F));
  Vec6 last = Vec6::Zero();
  for (const float pieces : {0.5F, 1.0F, 3.0F}) {
    const Vec6 drift = DriftOf(covariance, Pieces(pieces), config).diagonal();
    EXPECT_GT((drift - last).minCoeff(), 0.0F) << pieces;
    last = drift;
  }
}

TEST(Drift, OfOnePiece_IsThatOfOutlinesInItsPlace_AndOfThePosesNoiseInAll) {
  RegistrationConfig config;
  config.drift_noise = 9.0F;
  constexpr float kNoise = 1e-3F;
  const Mat6 noise = kNoise * kNoise * Mat6::Identity();
  const Mat6 drift = DriftOf(noise, Pieces(1.0F), config);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FLOAT_EQ(Std(drift, i), std::hypot(kOutline_m, 3.0F * kNoise, 3.0F * kNoise));
    EXPECT_FLOAT_EQ(Std(drift, 3 + i), 3.0F * kNoise);
  }
  // Of independent pieces variances add up.
  EXPECT_FLOAT_EQ(Std(DriftOf(noise, Pieces(4.0F), config), 0), 2.0F * Std(drift, 0));
}

// However many samples told it the depth: they err alike.
TEST(Drift, InTheDirectionThatIsToldBest_IsAsLargeAsTheMeanOfAll) {
  RegistrationConfig config;
  config.drift_noise = 4.0F;
  Vec6 variances;
  variances << 3e-6F, 3e-6F, 0.0F, 1e-6F, 1e-6F, 1e-6F;
  const Mat6 drift = DriftOf(variances.asDiagonal(), {.pieces = 1.0F, .lever_m = kLever_m}, config);
  EXPECT_FLOAT_EQ(drift(2, 2), 4.0F * 2e-6F);
  EXPECT_FLOAT_EQ(drift(0, 0), 4.0F * (3e-6F + 2e-6F));
  EXPECT_FLOAT_EQ(drift(5, 5), 4.0F * 1e-6F);
}

// A turn that is not known says nothing of where the turned surface's centre is.
TEST(Drift, OfThePlace_IsNoneOfTheTurnsBusiness) {
  Vec6 variances;
  variances << Vec3::Constant(1e-8F), 0.0F, 0.1F, 0.0F;
  const Mat6 drift = DriftOf(variances.asDiagonal(), Pieces(1.0F), {});
  EXPECT_LT(Std(drift, 0), 1e-3F);
  EXPECT_GT(Std(drift, 4), 0.3F);
}

TEST(Drift, OfSurfaceFarFromTheCentre_HasItsTurnAsWell) {
  RegistrationConfig config;
  config.drift_noise = 4.0F;
  Vec6 variances;
  variances << Vec3::Constant(1e-8F), Vec3::Constant(9e-6F);
  const PlacementScale scale = {.lever_m = kLever_m};
  const float expected_m2 = 4.0F * (1e-8F + 2.0F / 3.0F * 9e-6F * kLever_m * kLever_m);
  EXPECT_FLOAT_EQ(PieceVariance(variances.asDiagonal(), scale, config), expected_m2);
}

TEST(Drift, WhatTheSensorIsOffByFromViewToView_IsInThePoseFromTheFirstViewOn) {
  RegistrationConfig config;
  config.depth_bias_m = 2e-3F;
  const Mat6 first = DriftOf(Mat6::Zero(), Pieces(0.0F), config);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FLOAT_EQ(Std(first, i), 2e-3F);
    EXPECT_FLOAT_EQ(Std(first, 3 + i), 2e-3F / kLever_m);
  }
  EXPECT_GT(Std(DriftOf(Mat6::Zero(), Pieces(3.0F), config), 4), 1.9F * Std(first, 4));
}

TEST(Drift, WhatTheRegistrationKnowsBadly_StaysTheLargest) {
  Mat6 covariance = 1e-10F * Mat6::Identity();
  covariance(4, 4) = 0.04F;
  covariance(1, 4) = covariance(4, 1) = 1e-7F;
  const Mat6 drift = DriftOf(covariance, Pieces(2.0F), {});
  EXPECT_GT(Std(drift, 4), 0.2F);
  EXPECT_EQ(drift, Mat6(drift.transpose()));
  EXPECT_GE(drift(1, 4), covariance(1, 4));
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
