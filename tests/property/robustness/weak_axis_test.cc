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

TEST(WeakAxis, OfACan_IsNamed) {
  const TrackedSequence sequence = Track(host::ObjectKind::kCan, host::NoiseKind::kD415);
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

TEST(WeakAxis, OfABox_IsNeverNamed) {
  const TrackedSequence sequence = Track(host::ObjectKind::kBox, host::NoiseKind::kD415);
  for (const TrackedFrame& frame : sequence.frames())
    EXPECT_EQ(frame.estimate.weak.kind, WeakKind::kNone) << "frame " << frame.index;
}

}  // namespace
}  // namespace disflow::testing
