// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "disflow/flow/twist_filter.h"

namespace disflow {
namespace {

constexpr StampNs kFrame_ns = 33'333'333;
constexpr StampNs kStart_ns = 1'000'000'000'000;
constexpr float kPositionStd_m = 3e-4F;
constexpr float kRotationStd_rad = 2e-3F;
const Vec3 kAxis(0.6F, -0.64F, 0.48F);
const Mat3 kStartRotation = ExpSo3(Vec3(0.4F, -0.7F, 0.2F));
const Vec3 kStartPosition_m(0.05F, -0.1F, 0.6F);

Mat6 PoseCovariance() {
  Vec6 std;
  std << Vec3::Constant(kPositionStd_m), Vec3::Constant(kRotationStd_rad);
  return std.cwiseAbs2().asDiagonal();
}

/// Where the object is and how it moves, as a function of time: to and fro on a line and about an
/// axis, `rate_hz` times a second.
struct Swinging {
  float stroke_m;
  float angle_rad;
  float rate_hz;

  [[nodiscard]] float omega_rps() const { return 6.2832F * rate_hz; }
  [[nodiscard]] PoseCameraFromObject T_co(float t_s) const {
    const float phase = std::sin(omega_rps() * t_s);
    return {Mat3(ExpSo3(Vec3(angle_rad * phase * kAxis)) * kStartRotation),
            Vec3(kStartPosition_m + stroke_m * phase * Vec3::UnitY())};
  }
  [[nodiscard]] Vec6 twist(float t_s) const {
    const float rate = omega_rps() * std::cos(omega_rps() * t_s);
    Vec6 twist;
    twist << Vec3(stroke_m * rate * Vec3::UnitY()), Vec3(angle_rad * rate * kAxis);
    return twist;
  }
};

/// Poses with noise, their velocity's errors: the mean square of the linear one, and how large both
/// are beside what is stated (1 if that is true).
struct Errors {
  float linear_mps2 = 0.0F;
  float of_stated = 0.0F;
};

Errors ErrorsOf(const Swinging& motion, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  std::normal_distribution<float> normal;
  const auto noise = [&](float std) {
    return Vec3(std * Vec3(normal(random), normal(random), normal(random)));
  };
  TwistFilter filter;
  filter.Start({}, kStart_ns, motion.T_co(0.0F), PoseCovariance());
  constexpr int kFrames = 300;
  constexpr int kSettled = 90;
  Errors errors;
  for (int frame = 1; frame < kFrames; ++frame) {
    const StampNs since_ns = frame * kFrame_ns;
    const PoseCameraFromObject true_pose = motion.T_co(Seconds(since_ns));
    filter.Predict(kStart_ns + since_ns);
    filter.Update({Mat3(ExpSo3(noise(kRotationStd_rad)) * true_pose.rotation()),
                   Vec3(true_pose.translation() + noise(kPositionStd_m))},
                  PoseCovariance());
    if (frame < kSettled) continue;
    const Twist twist = filter.twist();
    Vec6 error;
    error << twist.linear_mps, twist.angular_rps;
    error -= motion.twist(Seconds(since_ns));
    errors.linear_mps2 += error.head<3>().squaredNorm() / (kFrames - kSettled);
    errors.of_stated +=
        error.dot(filter.twist_covariance().ldlt().solve(error)) / (6.0F * (kFrames - kSettled));
  }
  return errors;
}

TEST(TwistFilterJerk, ObjectAtRest_SeemsToMoveHalfAsMuchAsWithTheJerkThatIsAssumedOfOneInAHand) {
  // That has 1.4 cm/s, and the difference of two poses sqrt(6) * 0.3 mm a frame: 2.2 cm/s.
  for (int seed = 1; seed <= 5; ++seed) {
    const Errors errors = ErrorsOf({0.0F, 0.0F, 0.0F}, seed);
    EXPECT_LT(std::sqrt(errors.linear_mps2), 8e-3F) << seed;
  }
}

TEST(TwistFilterJerk, HoweverTheObjectMoves_ItsVelocityIsOffByWhatIsStated) {
  for (int seed = 1; seed <= 5; ++seed) {
    for (const float rate_hz : {0.0F, 0.2F, 0.7F, 1.5F}) {
      const Errors errors = ErrorsOf({0.05F, 0.4F, rate_hz}, seed);
      EXPECT_GT(errors.of_stated, 0.3F) << rate_hz << " Hz, seed " << seed;
      EXPECT_LT(errors.of_stated, 2.5F) << rate_hz << " Hz, seed " << seed;
    }
  }
}

}  // namespace
}  // namespace disflow
