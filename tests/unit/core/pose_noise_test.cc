// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace disflow {
namespace {

constexpr StampNs kFrame_ns = 33'333'333;
constexpr float kPositionStd_m = 2e-4F;
constexpr float kRotationStd_rad = 1e-3F;
const Vec3 kCenter_m(0.02F, -0.01F, 0.05F);
/// What is moved by hand has less jerk than is asked for by default.
constexpr TwistFilterConfig kCalm{.linear_jerk_psd = 0.01F, .angular_jerk_psd = 0.1F};

/// What the registration states, about the centre: not alike in all directions.
Mat6 Stated() {
  Vec6 std;
  std << kPositionStd_m, 3.0F * kPositionStd_m, 0.5F * kPositionStd_m, kRotationStd_rad,
      0.3F * kRotationStd_rad, 2.0F * kRotationStd_rad;
  Mat6 covariance = std.cwiseAbs2().asDiagonal();
  covariance(0, 4) = covariance(4, 0) = 0.5F * std[0] * std[4];
  return covariance;
}

/// An object that is moved by hand and registered with noise.
class Registered {
 public:
  /// @param of_position, of_rotation Its true variances, of the stated ones.
  /// @param late_std_s How far stamps are off.
  Registered(float of_position, float of_rotation, float late_std_s = 0.0F)
      : position_(std::sqrt(of_position)),
        rotation_(std::sqrt(of_rotation)),
        late_std_s_(late_std_s) {}

  /// Swings to and fro by 10 cm and 30 degrees every two seconds.
  void Run(int frames, StampNs step_ns = kFrame_ns) {
    for (int i = 0; i < frames; ++i) Step(step_ns);
  }
  void Step(StampNs step_ns) {
    stamp_ns_ += step_ns;
    const float late_s = late_std_s_ > 0.0F ? late_std_s_ * normal_(random_) : 0.0F;
    const PoseCameraFromObject pose = Pose(at_rest_ ? 0.25F : Seconds(stamp_ns_) - late_s);
    noise_.Learn(stamp_ns_, pose, kCenter_m, Stated(), kCalm);
  }
  /// Something hits it.
  void Jump() { jumped_m_.x() += 0.05F; }
  void Stop() { at_rest_ = true; }
  [[nodiscard]] PoseNoise& noise() { return noise_; }

 private:
  [[nodiscard]] PoseCameraFromObject Pose(float t_s) {
    const float phase = 3.14F * t_s;
    const Mat3 turned = ExpSo3(Vec3(0.26F * std::sin(phase) * Vec3(0.6F, 0.0F, 0.8F)));
    const Vec3 moved_m = Vec3(0.05F * std::cos(phase), 0.0F, 0.6F) + jumped_m_;
    const Mat6 factor = Stated().llt().matrixL();
    Vec6 white;
    for (int i = 0; i < 6; ++i) white[i] = normal_(random_);
    const Vec6 off = factor * white;
    // About the centre, in the object's axes.
    const Mat3 R_co = turned * ExpSo3(Vec3(rotation_ * off.tail<3>()));
    const Vec3 center_c_m = moved_m + turned * Vec3(position_ * off.head<3>());
    return {R_co, Vec3(center_c_m - R_co * kCenter_m)};
  }

  float position_;
  float rotation_;
  float late_std_s_;
  bool at_rest_ = false;
  Vec3 jumped_m_ = Vec3::Zero();
  StampNs stamp_ns_ = 0;
  std::mt19937 random_{3};
  std::normal_distribution<float> normal_;
  PoseNoise noise_;
};

/// What is learnt in the mean of many frames.
Vec2 Learnt(Registered& object, StampNs step_ns = kFrame_ns) {
  constexpr int kFrames = 600;
  object.Run(200, step_ns);
  Vec2 log_mean = Vec2::Zero();
  for (int i = 0; i < kFrames; ++i) {
    object.Step(step_ns);
    log_mean.x() += std::log(object.noise().of_position()) / kFrames;
    log_mean.y() += std::log(object.noise().of_rotation()) / kFrames;
  }
  return {std::exp(log_mean.x()), std::exp(log_mean.y())};
}

TEST(PoseNoise, PosesThatScatterByMoreOrLessThanTheirCovariances_AreKnownToDoSo) {
  for (const float truth : {0.3F, 1.0F, 4.0F}) {
    Registered object(truth, truth);
    const Vec2 learnt = Learnt(object);
    EXPECT_NEAR(learnt.x(), truth, 0.25F * truth);
    EXPECT_NEAR(learnt.y(), truth, 0.25F * truth);
  }
}

TEST(PoseNoise, PositionAndRotation_AreToldApart_WhereverTheOriginIs) {
  Registered object(0.4F, 3.0F);
  const Vec2 learnt = Learnt(object);
  EXPECT_NEAR(learnt.x(), 0.4F, 0.15F);
  EXPECT_NEAR(learnt.y(), 3.0F, 0.75F);
  const Mat6 scatter = object.noise().Of(Stated());
  EXPECT_FLOAT_EQ(scatter(1, 1), object.noise().of_position() * Stated()(1, 1));
  EXPECT_FLOAT_EQ(scatter(5, 5), object.noise().of_rotation() * Stated()(5, 5));
  EXPECT_NEAR(scatter(0, 4) / std::sqrt(scatter(0, 0) * scatter(4, 4)), 0.5F, 1e-4F);
}

TEST(PoseNoise, UnevenStepsAndMissingFrames_AreNoNoise) {
  Registered object(1.0F, 1.0F);
  std::mt19937 random(8);
  std::uniform_int_distribution<StampNs> step_ns(kFrame_ns / 2, 3 * kFrame_ns / 2);
  for (int i = 0; i < 600; ++i) object.Step(i % 5 == 0 ? 2 * kFrame_ns : step_ns(random));
  EXPECT_GT(object.noise().of_position(), 0.5F);
  EXPECT_LT(object.noise().of_position(), 2.0F);
  EXPECT_GT(object.noise().of_rotation(), 0.5F);
  EXPECT_LT(object.noise().of_rotation(), 2.0F);
}

/// Deviation of stamps that is learnt in the mean of many frames.
float LearntOfStamps(Registered& object) {
  constexpr int kFrames = 600;
  object.Run(200);
  float variance_s2 = 0.0F;
  for (int i = 0; i < kFrames; ++i) {
    object.Step(kFrame_ns);
    variance_s2 += object.noise().of_stamps_s2() / kFrames;
  }
  return std::sqrt(variance_s2);
}

TEST(PoseNoise, StampsThatAreOff_AreKnownToBeByHowMuch_AndAreNotTakenForNoiseOfThePoses) {
  for (const float late_std_s : {0.004F, 0.006F, 0.008F}) {
    Registered object(0.06F, 0.06F, late_std_s);
    EXPECT_NEAR(LearntOfStamps(object), late_std_s, 0.3F * late_std_s);
    EXPECT_LT(object.noise().of_position(), 0.3F);
    EXPECT_LT(object.noise().of_rotation(), 0.3F);
  }
}

TEST(PoseNoise, WhereStampsAreExact_NoiseOfThePosesIsNotTakenForTheirs) {
  for (const float noise : {0.3F, 1.0F, 4.0F}) {
    Registered object(noise, noise);
    EXPECT_LT(LearntOfStamps(object), 5e-4F);
  }
}

TEST(PoseNoise, AnObjectAtRest_TellsNothingOfStamps) {
  Registered object(0.06F, 0.06F, 0.008F);
  object.Run(300);
  const float known_s2 = object.noise().of_stamps_s2();
  object.Stop();
  object.Run(4);  // until it is seen to stand still
  const float before_s2 = object.noise().of_stamps_s2();
  object.Run(300);
  EXPECT_GT(known_s2, 4e-6F);
  EXPECT_NEAR(object.noise().of_stamps_s2(), before_s2, 0.5F * before_s2);
}

TEST(PoseNoise, JerkThatIsExpectedOfTheMotion_IsNoNoise) {
  // Registered as exactly as without noise: nothing but the motion is left.
  for (const float jerk_psd : {1e-6F, 1e8F}) {
    PoseNoise noise;
    const TwistFilterConfig motion{.linear_jerk_psd = jerk_psd, .angular_jerk_psd = jerk_psd};
    for (int i = 1; i < 300; ++i) {
      const float phase = 20.0F * Seconds(i * kFrame_ns);
      noise.Learn(i * kFrame_ns,
                  {Mat3(ExpSo3(Vec3(0.5F * std::sin(phase) * Vec3::UnitY()))),
                   Vec3(0.1F * std::cos(phase), 0.0F, 0.6F)},
                  kCenter_m, Stated(), motion);
    }
    const bool expected = jerk_psd > 1.0F;
    EXPECT_EQ(noise.of_position() < 0.1F, expected) << noise.of_position();
    EXPECT_EQ(noise.of_rotation() < 0.1F, expected) << noise.of_rotation();
  }
}

TEST(PoseNoise, AHitNowAndThen_IsNoNoise) {
  Registered object(1.0F, 1.0F);
  for (int i = 0; i < 40; ++i) {
    object.Run(12);
    object.Jump();
  }
  EXPECT_LT(object.noise().of_position(), 2.5F);
}

TEST(PoseNoise, AfterARestart_TheLastPosesDoNotCount) {
  Registered object(1.0F, 1.0F);
  object.Run(300);
  for (int i = 0; i < 300; ++i) {
    object.Jump();
    object.noise().Restart();
    const float before = object.noise().of_position();
    object.Run(3);
    ASSERT_EQ(object.noise().of_position(), before);
  }
}

TEST(PoseNoise, PosesThatAreAlike_OrScatterWithoutBounds_LeaveASizeToWorkWith) {
  PoseNoise still;
  PoseNoise wild;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> anywhere(-1.0F, 1.0F);
  for (int i = 1; i < 2000; ++i) {
    const PoseCameraFromObject fixed(Mat3::Identity(), Vec3(0.0F, 0.0F, 0.5F));
    still.Learn(i * kFrame_ns, fixed, kCenter_m, Stated(), kCalm);
    const Vec3 somewhere_m(anywhere(random), anywhere(random), anywhere(random));
    wild.Learn(i * kFrame_ns, {Mat3(ExpSo3(somewhere_m)), somewhere_m}, kCenter_m, Stated(), kCalm);
  }
  EXPECT_GT(still.of_position(), 0.01F);
  EXPECT_GT(still.of_rotation(), 0.01F);
  EXPECT_LT(wild.of_position(), 100.0F);
  EXPECT_LT(wild.of_rotation(), 100.0F);
  EXPECT_EQ(still.of_stamps_s2(), 0.0F);
  EXPECT_LE(std::sqrt(wild.of_stamps_s2()), 0.3F * Seconds(kFrame_ns));
}

TEST(PoseNoise, WhatIsNoCovarianceOrNoPose_ChangesNothing) {
  Registered object(1.0F, 1.0F);
  object.Run(50);
  PoseNoise noise = object.noise();
  const float before = noise.of_position();
  StampNs stamp_ns = 51 * kFrame_ns;
  const PoseCameraFromObject pose(Mat3::Identity(), Vec3(0.0F, 0.0F, 0.5F));
  noise.Learn(stamp_ns += kFrame_ns, pose, kCenter_m,
              std::numeric_limits<float>::quiet_NaN() * Mat6::Identity(), kCalm);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int i = 0; i < 5; ++i) {
    noise.Learn(stamp_ns += kFrame_ns, {Mat3(Mat3::Constant(nan)), Vec3(Vec3::Constant(nan))},
                kCenter_m, Stated(), kCalm);
  }
  // Not even a stamp that stands still.
  noise.Restart();
  for (int i = 0; i < 5; ++i) noise.Learn(stamp_ns, pose, kCenter_m, Stated(), kCalm);
  EXPECT_EQ(noise.of_position(), before);
}

}  // namespace
}  // namespace disflow
