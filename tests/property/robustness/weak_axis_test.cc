// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tracked_sequence.h"

namespace disflow::testing {
namespace {

constexpr int kFrames = 40;
constexpr int kSettled = 3;

/// Tracks a moving object.
TrackedSequence Track(host::ObjectKind object, host::NoiseKind noise) {
  host::SimulationOptions options = Scene(object, kFrames);
  options.noise = noise;
  TrackedSequence sequence(options);
  sequence.Run(kFrames);
  return sequence;
}

class WeakAxis : public ::testing::TestWithParam<host::NoiseKind> {};

TEST_P(WeakAxis, OfACan_IsNamed) {
  const TrackedSequence sequence = Track(host::ObjectKind::kCan, GetParam());
  for (const TrackedFrame& frame : sequence.frames()) {
    if (frame.index < kSettled) continue;
    const WeakDirection& weak = frame.estimate.weak;
    ASSERT_EQ(weak.kind, WeakKind::kRotation) << "frame " << frame.index;
    const host::Vec3d axis = sequence.Truth(frame.index).object.pose.rotation().col(2);
    EXPECT_GT(std::abs(axis.dot(weak.axis.cast<double>())), std::cos(10.0 * 3.14159 / 180.0));
    // The covariance says the same: much about the axis, little across it.
    const Mat3 rotation = frame.estimate.pose_covariance.bottomRightCorner<3, 3>();
    const Vec3 about = axis.cast<float>();
    const Vec3 across = about.unitOrthogonal();
    EXPECT_GT(about.dot(rotation * about), 4.0F * across.dot(rotation * across));
    EXPECT_NEAR(weak.std, std::sqrt(about.dot(rotation * about)), 0.1F * weak.std);
  }
}

// A can's turn about its axis adds up unseen; neither the state nor the covariance hides that.
TEST_P(WeakAxis, TurnOfACan_IsNeverClaimedToBeKnown) {
  const TrackedSequence sequence = Track(host::ObjectKind::kCan, GetParam());
  ASSERT_GT(sequence.last().off_deg, 10.0);
  EXPECT_EQ(sequence.LongestLie(), 0);
  for (const TrackedFrame& frame : sequence.frames()) {
    if (frame.index < kSettled) continue;
    EXPECT_NE(frame.estimate.state, TrackingState::kTracking) << "frame " << frame.index;
    const double std_deg = static_cast<double>(frame.estimate.weak.std) * 180.0 / 3.14159;
    EXPECT_LT(frame.off_deg, 3.0 * std_deg) << "frame " << frame.index;
  }
}

TEST_P(WeakAxis, OfABox_IsNeverNamed) {
  const TrackedSequence sequence = Track(host::ObjectKind::kBox, GetParam());
  for (const TrackedFrame& frame : sequence.frames())
    EXPECT_EQ(frame.estimate.weak.kind, WeakKind::kNone) << "frame " << frame.index;
}

// Correlated noise bends the model's own normals, which the frames' show.
INSTANTIATE_TEST_SUITE_P(Noise, WeakAxis,
                         ::testing::Values(host::NoiseKind::kWhite, host::NoiseKind::kD415),
                         [](const auto& noise) {
                           return noise.param == host::NoiseKind::kWhite ? "White" : "D415";
                         });

}  // namespace
}  // namespace disflow::testing
