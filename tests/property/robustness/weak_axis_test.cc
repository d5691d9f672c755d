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
TrackedSequence Track(host::ObjectKind object, host::NoiseKind noise, int frames = kFrames) {
  host::SimulationOptions options = Scene(object, frames);
  options.noise = noise;
  TrackedSequence sequence(options);
  sequence.Run(frames);
  return sequence;
}

TEST(WeakAxis, OfACan_IsNamed) {
  const TrackedSequence sequence = Track(host::ObjectKind::kCan, host::NoiseKind::kWhite);
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
TEST(WeakAxis, TurnOfACan_IsNeverClaimedToBeKnown) {
  // The prediction carries the turn on for a while.
  constexpr int kUntilItIsLost = 150;
  const TrackedSequence sequence =
      Track(host::ObjectKind::kCan, host::NoiseKind::kWhite, kUntilItIsLost);
  ASSERT_GT(sequence.last().off_deg, 10.0);
  EXPECT_EQ(sequence.LongestLie(), 0);
  for (const TrackedFrame& frame : sequence.frames()) {
    if (frame.index < kSettled) continue;
    EXPECT_NE(frame.estimate.state, TrackingState::kTracking) << "frame " << frame.index;
    const double std_deg = static_cast<double>(frame.estimate.weak.std) * 180.0 / 3.14159;
    EXPECT_LT(frame.off_deg, 3.0 * std_deg) << "frame " << frame.index;
  }
}

// How it is turned about its axis, and which of its two lids is up, cannot be known afterwards: all
// else is.
TEST(WeakAxis, CanThatWasHiddenForSecondsAndMoved_IsRecognised) {
  constexpr int kHidden = 100;
  constexpr int kBack = 160;
  constexpr int kHalfASecond = 15;
  for (const unsigned seed : {1U, 3U, 7U}) {
    host::SimulationOptions options = Scene(host::ObjectKind::kCan, kBack + 30);
    options.motion = host::MotionKind::kFast;
    options.seed = seed;
    TrackedSequence sequence(options);
    sequence.Run(kBack + 30, [](int i) {
      return i >= kHidden && i < kBack ? TrackedSequence::Fate::kBlank
                                       : TrackedSequence::Fate::kSeen;
    });
    ASSERT_EQ(sequence.At(kBack - 1).estimate.state, TrackingState::kLost);
    for (const TrackedFrame& frame : sequence.frames()) {
      if (frame.index < kBack) continue;
      EXPECT_EQ(frame.estimate.reset_counter, 0) << seed << ", frame " << frame.index;
      if (frame.index < kBack + kHalfASecond) continue;
      EXPECT_EQ(frame.estimate.status, Status::kOk) << seed << ", frame " << frame.index;
      // The turn that the pose is off by leaves the can's middle and its axis in place.
      const auto truth = sequence.Truth(frame.index).object.pose;
      const host::Vec3d axis = truth.rotation().col(2);
      EXPECT_GT(std::abs(axis.dot(frame.T_claimed.rotation().col(2))),
                std::cos(2.0 * 3.14159 / 180.0))
          << seed << ", frame " << frame.index;
      EXPECT_LT(frame.off_m, 0.003) << seed << ", frame " << frame.index;
    }
  }
}

TEST(WeakAxis, OfABox_IsNeverNamed) {
  const TrackedSequence sequence = Track(host::ObjectKind::kBox, host::NoiseKind::kWhite);
  for (const TrackedFrame& frame : sequence.frames())
    EXPECT_EQ(frame.estimate.weak.kind, WeakKind::kNone) << "frame " << frame.index;
}

// Correlated noise bends the model's own normals, so that a can seems to have features that hold
// its turn. What the frames' normals show of that tells, once the model has averaged some frames.
TEST(WeakAxis, TurnOfACanUnderCorrelatedNoise_IsMostlySaidToBeUnknown) {
  constexpr int kAveraged = 16;
  const TrackedSequence sequence = Track(host::ObjectKind::kCan, host::NoiseKind::kD415);
  int said = 0;
  int frames = 0;
  double farthest_deg = 0.0;
  for (const TrackedFrame& frame : sequence.frames()) {
    if (frame.index < kAveraged) continue;
    ++frames;
    farthest_deg = std::max(farthest_deg, frame.off_deg);
    const double std_deg = static_cast<double>(frame.estimate.weak.std) * 180.0 / 3.14159;
    const bool doubts = frame.estimate.state != TrackingState::kTracking;
    if (doubts && frame.off_deg < 3.0 * std_deg) ++said;
  }
  ASSERT_GT(farthest_deg, 10.0);
  EXPECT_GT(10 * said, 9 * frames) << said << " of " << frames;
}

TEST(WeakAxis, OfABoxUnderCorrelatedNoise_IsNeverNamed) {
  const TrackedSequence sequence = Track(host::ObjectKind::kBox, host::NoiseKind::kD415);
  for (const TrackedFrame& frame : sequence.frames())
    EXPECT_EQ(frame.estimate.weak.kind, WeakKind::kNone) << "frame " << frame.index;
}

// Of a box that turns a face towards the camera nothing but outlines tells where it is along that
// face. Where rare images let them get out of reach, it is looked for in the image after.
TEST(WeakAxis, FaceThatSlid_IsBackInItsPlaceInTheNextImage) {
  constexpr int kUntilItTurnedOn = 60;
  for (const unsigned seed : {4U, 17U, 19U}) {
    host::SimulationOptions options = Scene(host::ObjectKind::kBox, kUntilItTurnedOn);
    options.motion = host::MotionKind::kFast;
    options.noise = host::NoiseKind::kD415;
    options.mask = host::MaskKind::kNone;
    options.fps = 15.0;
    options.seed = seed;
    TrackedSequence sequence(options);
    sequence.Run(kUntilItTurnedOn);
    int slid = 0;
    double farthest_m = 0.0;
    double farthest_for_two_m = 0.0;
    double before_m = 0.0;
    for (const TrackedFrame& frame : sequence.frames()) {
      slid += frame.estimate.weak.kind == WeakKind::kTranslation ? 1 : 0;
      farthest_m = std::max(farthest_m, frame.off_m);
      farthest_for_two_m = std::max(farthest_for_two_m, std::min(before_m, frame.off_m));
      before_m = frame.off_m;
    }
    ASSERT_GT(slid, 0) << seed;
    EXPECT_LT(farthest_m, 0.02) << seed;
    EXPECT_LT(farthest_for_two_m, 0.012) << "in two images in a row, seed " << seed;
  }
}

}  // namespace
}  // namespace disflow::testing
