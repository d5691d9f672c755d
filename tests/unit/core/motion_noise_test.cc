// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/motion_noise.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

namespace disflow {
namespace {

/// What a filter expects its predictions to be off by: not alike in all directions.
Mat6 Expected() {
  Vec6 std;
  std << 2e-4F, 6e-4F, 1e-4F, 1e-3F, 3e-4F, 2e-3F;
  Mat6 covariance = std.cwiseAbs2().asDiagonal();
  covariance(0, 1) = covariance(1, 0) = 0.5F * std[0] * std[1];
  covariance(1, 4) = covariance(4, 1) = 0.3F * std[1] * std[4];
  return covariance;
}

/// Innovations of which each has a share in common with the one before.
class Innovations {
 public:
  /// @param alike Their correlation.
  /// @param position, rotation Their variances, of what is expected.
  explicit Innovations(float alike, float position = 1.0F, float rotation = 1.0F)
      : alike_(alike), position_(std::sqrt(position)), rotation_(std::sqrt(rotation)) {}

  Vec6 Next() {
    const float rest = std::sqrt(1.0F - alike_ * alike_);
    for (int i = 0; i < 6; ++i) white_[i] = alike_ * white_[i] + rest * normal_(random_);
    Vec6 innovation;
    innovation.head<3>() =
        position_ * (Mat3(Expected().topLeftCorner<3, 3>().llt().matrixL()) * white_.head<3>());
    innovation.tail<3>() =
        rotation_ * (Mat3(Expected().bottomRightCorner<3, 3>().llt().matrixL()) * white_.tail<3>());
    return innovation;
  }

 private:
  float alike_;
  float position_;
  float rotation_;
  Vec6 white_ = Vec6::Zero();
  std::mt19937 random_{7};
  std::normal_distribution<float> normal_;
};

MotionNoise After(Innovations innovations, int frames, float times = 1.0F) {
  MotionNoise noise;
  for (int i = 0; i < frames; ++i) noise.Learn(times * innovations.Next(), Expected());
  return noise;
}

TEST(MotionNoise, InnovationsThatAgree_TellOfMoreJerkAndThoseThatAlternateOfLess) {
  const MotionNoise sluggish = After(Innovations(0.5F), 90);
  EXPECT_GT(sluggish.of_position(), 2.0F);
  EXPECT_GT(sluggish.of_rotation(), 2.0F);
  const MotionNoise nervous = After(Innovations(-0.5F), 90);
  EXPECT_LT(nervous.of_position(), 0.2F);
  EXPECT_LT(nervous.of_rotation(), 0.2F);
}

TEST(MotionNoise, InnovationsThatHaveNothingInCommon_LeaveTheJerkAlone) {
  // A random walk with steps of 0.1 / sqrt(3) each, and no pull: on average it stays.
  float logs = 0.0F;
  Innovations innovations(0.0F);
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    MotionNoise noise;
    for (int i = 0; i < 100; ++i) noise.Learn(innovations.Next(), Expected());
    logs += std::log(noise.of_position()) + std::log(noise.of_rotation());
  }
  EXPECT_NEAR(logs / (2.0F * kRuns), 0.0F, 0.35F);
}

TEST(MotionNoise, JerkIsOfTheirDirections_WhateverTheirSize) {
  for (const float times : {1e-6F, 0.1F, 30.0F}) {
    EXPECT_NEAR(After(Innovations(-0.5F), 20, times).of_position(),
                After(Innovations(-0.5F), 20).of_position(), 1e-3F)
        << times;
  }
}

TEST(MotionNoise, Scatter_IsFoundForPositionAndRotationApart) {
  for (const auto& [position, rotation] :
       {std::pair{1.0F, 1.0F}, std::pair{0.1F, 4.0F}, std::pair{9.0F, 0.3F}}) {
    const Mat6 found = After(Innovations(0.0F, position, rotation), 400).Of(Expected());
    EXPECT_NEAR(std::log(found(0, 0) / (position * Expected()(0, 0))), 0.0F, 0.5F) << position;
    EXPECT_NEAR(std::log(found(5, 5) / (rotation * Expected()(5, 5))), 0.0F, 0.5F) << rotation;
  }
}

TEST(MotionNoise, ScaledCovariance_KeepsItsCorrelations) {
  const Mat6 found = After(Innovations(0.0F, 0.1F, 4.0F), 400).Of(Expected());
  const auto correlation = [](const Mat6& covariance, int i, int j) {
    return covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
  };
  EXPECT_NEAR(correlation(found, 0, 1), 0.5F, 1e-4F);
  EXPECT_NEAR(correlation(found, 1, 4), 0.3F, 1e-4F);
}

TEST(MotionNoise, OneHitInTen_LeavesTheScatterAlone) {
  MotionNoise noise;
  Innovations innovations(0.0F);
  for (int i = 0; i < 400; ++i) {
    noise.Learn((i % 10 == 0 ? 50.0F : 1.0F) * innovations.Next(), Expected());
  }
  EXPECT_NEAR(std::log(noise.Of(Expected())(0, 0) / Expected()(0, 0)), 0.0F, 0.7F);
}

TEST(MotionNoise, AfterAHit_ItIsAtLeastWhatWasAssumed) {
  MotionNoise calm = After(Innovations(-0.5F, 0.1F, 0.1F), 200);
  ASSERT_LT(calm.of_position(), 0.5F);
  calm.Restart();
  EXPECT_EQ(calm.of_position(), 1.0F);
  EXPECT_EQ(calm.of_rotation(), 1.0F);
  EXPECT_LT((calm.Of(Expected()) - Expected()).norm(), 1e-6F * Expected().norm());
  MotionNoise shaken = After(Innovations(0.5F, 5.0F, 5.0F), 200);
  const float before = shaken.of_position();
  ASSERT_GT(before, 1.5F);
  shaken.Restart();
  EXPECT_EQ(shaken.of_position(), before);
}

TEST(MotionNoise, FirstInnovationAfterAHit_IsComparedWithNone) {
  MotionNoise noise;
  noise.Learn(Vec6(Vec6::Constant(1e-4F)), Expected());
  noise.Restart();
  noise.Learn(Vec6(Vec6::Constant(1e-4F)), Expected());
  EXPECT_EQ(noise.of_position(), 1.0F);
  noise.Learn(Vec6(Vec6::Constant(1e-4F)), Expected());
  EXPECT_GT(noise.of_position(), 1.0F);
}

TEST(MotionNoise, InnovationAfterAFrameThatTellsNothing_IsComparedWithNone) {
  MotionNoise noise;
  for (int i = 0; i < 10; ++i) {
    noise.Learn(Vec6(Vec6::Constant(1e-4F)), Expected());
    noise.Pause();
  }
  EXPECT_EQ(noise.of_position(), 1.0F);
  EXPECT_EQ(noise.of_rotation(), 1.0F);
}

TEST(MotionNoise, WhateverComes_StaysWithinItsBounds) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  for (const float value : {0.0F, 1e-30F, 1e30F, nan, inf, -inf}) {
    for (const Mat6& expected :
         {Expected(), Mat6(Mat6::Zero()), Mat6(-Expected()), Mat6(Mat6::Constant(nan))}) {
      MotionNoise noise;
      for (int i = 0; i < 200; ++i) noise.Learn(Vec6(Vec6::Constant(value)), expected);
      for (const float jerk : {noise.of_position(), noise.of_rotation()}) {
        EXPECT_GE(jerk, 1.0F / 30.0F) << value;
        EXPECT_LE(jerk, 3.0F) << value;
      }
      const Mat6 found = noise.Of(Expected());
      EXPECT_GE(found(0, 0), 0.03F * Expected()(0, 0)) << value;
      EXPECT_LE(found(0, 0), 31.0F * Expected()(0, 0)) << value;
    }
  }
}

}  // namespace
}  // namespace disflow
