// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>

#include "tracked_sequence.h"

namespace disflow::testing {
namespace {

/// Drivers that stamp an image when it arrives are a few milliseconds off, otherwise each time.
class StampsThatAreOff : public ::testing::TestWithParam<host::ObjectKind> {
 protected:
  static constexpr int kFrames = 200;
  static constexpr int kSettled = 60;

  StampsThatAreOff() : sequence_(Options()) { sequence_.Run(kFrames); }

  /// (v, omega) of the simulated object's own origin.
  [[nodiscard]] Vec6 TrueTwist(int index) const {
    const auto truth = sequence_.Truth(index).object;
    Vec6 twist;
    twist << truth.linear_mps.cast<float>(), truth.angular_rps.cast<float>();
    return twist;
  }
  [[nodiscard]] Vec6 StatedTwist(int index) const {
    const TrackedFrame& frame = sequence_.At(index);
    const Vec3 lever_m =
        frame.T_claimed.translation().cast<float>() - Vec3(frame.estimate.T_co.translation());
    const Twist& stated = frame.estimate.twist;
    Vec6 twist;
    twist << stated.linear_mps + stated.angular_rps.cross(lever_m), stated.angular_rps;
    return twist;
  }
  /// What anybody makes of poses and stamps.
  [[nodiscard]] Vec6 Difference(int index) const {
    const TrackedFrame& before = sequence_.At(index - 1);
    const TrackedFrame& now = sequence_.At(index);
    const float dt_s = Seconds(SpanNs(before.estimate.stamp_ns, now.estimate.stamp_ns));
    Vec6 step;
    step << (now.T_claimed.translation() - before.T_claimed.translation()).cast<float>(),
        TurnBetween(before.T_claimed.rotation(), now.T_claimed.rotation()).cast<float>();
    return step / dt_s;
  }

  TrackedSequence sequence_;

 private:
  static host::SimulationOptions Options() {
    host::SimulationOptions options = Scene(GetParam(), kFrames);
    options.motion = host::MotionKind::kFast;
    options.noise = host::NoiseKind::kD415;
    options.jitter_ms = 3.0;
    options.seed = 3;
    return options;
  }
};

TEST_P(StampsThatAreOff, TwistIsBetterThanDifferencesOfThePoses_AndSaysHowGood) {
  Vec2 stated = Vec2::Zero();
  Vec2 by_differences = Vec2::Zero();
  int inside = 0;
  for (int i = kSettled; i < kFrames; ++i) {
    const Vec6 truth = TrueTwist(i);
    const Vec6 error = StatedTwist(i) - truth;
    const Vec6 of_difference = Difference(i) - truth;
    stated += Vec2(error.head<3>().squaredNorm(), error.tail<3>().squaredNorm());
    by_differences +=
        Vec2(of_difference.head<3>().squaredNorm(), of_difference.tail<3>().squaredNorm());
    // 97.5 % of chi-squared with six degrees of freedom.
    const Mat6& covariance = sequence_.At(i).estimate.twist_covariance;
    inside += int{error.dot(covariance.ldlt().solve(error)) < 14.45F};
  }
  // Root mean squares: less than nine tenths.
  EXPECT_LT(stated.x(), 0.8F * by_differences.x());
  EXPECT_LT(stated.y(), 0.8F * by_differences.y());
  EXPECT_GT(inside, (kFrames - kSettled) * 3 / 4);
}

INSTANTIATE_TEST_SUITE_P(Objects, StampsThatAreOff,
                         ::testing::Values(host::ObjectKind::kBox, host::ObjectKind::kBottle));

}  // namespace
}  // namespace disflow::testing
