// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "disflow/host/simulated_shapes.h"
#include "tracked_sequence.h"

namespace disflow::testing {
namespace {

using Fate = TrackedSequence::Fate;
using host::ObjectKind;

constexpr int kFrames = 60;
constexpr int kGone = 30;  // the simulated curtain comes down after 1 s and goes up after 1.5 s
constexpr int kBack = 45;
constexpr int kLossFrames = 3;

double PositionStd(const TrackedFrame& frame) {
  return std::sqrt(
      static_cast<double>(frame.estimate.pose_covariance.topLeftCorner<3, 3>().trace()));
}
double RotationStd(const TrackedFrame& frame) {
  return std::sqrt(
      static_cast<double>(frame.estimate.pose_covariance.bottomRightCorner<3, 3>().trace()));
}

/// A depth image of nothing else.
std::vector<float> DepthOfABall(const host::SimulationOptions& options, const Vec3& center_m,
                                float radius_m) {
  const PinholeCamera camera = host::SimulatedCamera(options);
  std::vector<float> depth_m;
  for (int v = 0; v < options.height_px; ++v) {
    for (int u = 0; u < options.width_px; ++u) {
      const Vec3 ray = camera.Ray(static_cast<float>(u), static_cast<float>(v));
      const float along = ray.dot(center_m);
      const float under_root =
          along * along - ray.squaredNorm() * (center_m.squaredNorm() - radius_m * radius_m);
      depth_m.push_back(under_root < 0.0F ? 0.0F
                                          : (along - std::sqrt(under_root)) / ray.squaredNorm());
    }
  }
  return depth_m;
}

/// Whatever happens, no sequence of this file may be lied about.
class Loss : public ::testing::TestWithParam<ObjectKind> {
 protected:
  TrackedSequence& Track(
      const host::SimulationOptions& options, int frames,
      const std::function<Fate(int)>& fate = [](int) { return Fate::kSeen; }) {
    sequence_ = std::make_unique<TrackedSequence>(options);
    sequence_->Run(frames, fate);
    EXPECT_LE(sequence_->LongestLie(turn_deg_), kLossFrames);
    return *sequence_;
  }
  /// Follows an object, and after two seconds more is offered images of another in its place.
  /// @param check check(frame, what is said, where the other object is)
  template <class Check>
  void OfferAnotherInItsPlace(host::MotionKind motion, const Check& check) {
    constexpr int kChange = 60;
    const bool is_box = GetParam() == ObjectKind::kBox;
    host::SimulationOptions other =
        Scene(is_box ? ObjectKind::kBottle : ObjectKind::kBox, kChange + 150);
    other.motion = motion;
    host::Simulation replaced(other, host::MakeObjectMesh(other.object));
    TrackedSequence& sequence = Track(Scene(GetParam(), kChange), kChange);
    for (int i = kChange + 60; i < kChange + 100; ++i) {
      DepthFrame frame;
      replaced.Render(i, frame);
      check(i, sequence.Offer(frame), replaced.TruthAt(i).object.pose.translation());
    }
  }
  void ExpectSameObjectFrame(double most_deg = 2.0) const {
    EXPECT_EQ(sequence_->last().estimate.reset_counter, 0);
    EXPECT_EQ(sequence_->last().estimate.state, TrackingState::kTracking);
    EXPECT_LT(sequence_->last().off_m, 0.004);
    EXPECT_LT(sequence_->last().off_deg, most_deg);
  }

  double TrackedFrame::*turn_deg_ = &TrackedFrame::off_deg;  ///< What a lie is told by.

 private:
  std::unique_ptr<TrackedSequence> sequence_;
};

TEST_P(Loss, ImpulsesBetweenRareImages_AreFollowedWithoutAMask) {
  // 1.2 m/s and jumps of the velocity: 8 cm and 33 degrees from one image to the next.
  constexpr int kFlyingFrames = 120;
  host::SimulationOptions options = Scene(GetParam(), kFlyingFrames);
  options.motion = host::MotionKind::kFlying;
  options.noise = host::NoiseKind::kClean;
  options.fps = 15.0;
  options.mask = host::MaskKind::kNone;
  options.seed = 2;
  const TrackedSequence& sequence = Track(options, kFlyingFrames);
  int unregistered = 0;
  for (const TrackedFrame& frame : sequence.frames())
    unregistered += int{frame.estimate.status != Status::kOk};
  EXPECT_LE(unregistered, 2);
  // What is learnt of a bottle between jumps turns it by two degrees.
  ExpectSameObjectFrame(3.0);
}

TEST_P(Loss, FullOcclusion_IsStatedAtOnceAndSurvived) {
  host::SimulationOptions options = Scene(GetParam(), kFrames);
  options.occluder = host::OccluderKind::kCurtain;
  const TrackedSequence& sequence = Track(options, kFrames);
  const TrackedFrame& before = sequence.At(kGone - 1);
  ASSERT_EQ(before.estimate.state, TrackingState::kTracking);
  EXPECT_EQ(sequence.At(kGone + kLossFrames - 1).estimate.state, TrackingState::kLost);
  // The quality tells before the state does.
  for (int i = kGone; i < kGone + kLossFrames; ++i)
    EXPECT_LE(sequence.At(i).estimate.quality, before.estimate.quality / 2);
  for (int i = kGone; i < kBack; ++i) {
    EXPECT_NE(sequence.At(i).estimate.status, Status::kOk);
    EXPECT_GT(PositionStd(sequence.At(i)), PositionStd(sequence.At(i - 1))) << "frame " << i;
    EXPECT_GT(RotationStd(sequence.At(i)), RotationStd(sequence.At(i - 1))) << "frame " << i;
  }
  EXPECT_EQ(sequence.At(kBack + 1).estimate.state, TrackingState::kRecovered);
  ExpectSameObjectFrame();
}

TEST_P(Loss, FullOcclusionWithoutAMask_IsSurvived) {
  host::SimulationOptions options = Scene(GetParam(), kFrames);
  options.occluder = host::OccluderKind::kCurtain;
  options.mask = host::MaskKind::kNone;
  const TrackedSequence& sequence = Track(options, kFrames);
  EXPECT_EQ(sequence.At(kGone + kLossFrames - 1).estimate.state, TrackingState::kLost);
  ExpectSameObjectFrame();
}

TEST_P(Loss, FastThingThatLooksAlikeTurnedOver_IsFoundAsItsMotionTurnedIt) {
  // Half a second in which it turns by 60 to 120 degrees: one side of two that look alike is seen.
  host::SimulationOptions options = Scene(GetParam(), 100);
  options.occluder = host::OccluderKind::kCurtain;
  options.motion = host::MotionKind::kFast;
  options.noise = host::NoiseKind::kD415;
  options.seed = 8;
  const TrackedSequence& sequence = Track(options, 100);
  EXPECT_TRUE(sequence.WasEver(TrackingState::kRecovered));
  ExpectSameObjectFrame();
}

TEST_P(Loss, DroppedFrames_AreBridged) {
  const TrackedSequence& sequence = Track(Scene(GetParam(), kFrames), kFrames, [](int i) {
    return i >= kGone && i < kBack ? Fate::kDropped : Fate::kSeen;
  });
  EXPECT_LT(sequence.At(kBack + 2).off_m, 0.004);
  ExpectSameObjectFrame();
}

TEST_P(Loss, ObjectThatLeavesTheView_IsFoundAgainWhenItComesBack) {
  constexpr int kLeaving = 100;
  host::SimulationOptions options = Scene(GetParam(), kLeaving);
  options.motion = host::MotionKind::kLeaving;
  const TrackedSequence& sequence = Track(options, kLeaving);
  EXPECT_TRUE(sequence.WasEver(TrackingState::kLost));
  EXPECT_TRUE(sequence.WasEver(TrackingState::kRecovered));
  ExpectSameObjectFrame();
}

TEST_P(Loss, ObjectThatWasHiddenForSecondsAndMoved_IsRecognisedWithinHalfASecond) {
  constexpr int kHidden = 120;
  constexpr int kHalfASecond = 15;
  for (const int seen_again : {kHidden + 45, kHidden + 100}) {
    SCOPED_TRACE(seen_again);
    host::SimulationOptions options = Scene(GetParam(), seen_again + 25);
    options.seed = 3;
    const TrackedSequence& sequence = Track(options, seen_again + 25, [=](int i) {
      return i >= kHidden && i < seen_again ? Fate::kBlank : Fate::kSeen;
    });
    // It is elsewhere.
    const auto before = sequence.Truth(kHidden - 1).object.pose;
    const auto after = sequence.Truth(seen_again).object.pose;
    EXPECT_GT((before.translation() - after.translation()).norm(), 0.03);
    EXPECT_EQ(sequence.At(seen_again - 1).estimate.state, TrackingState::kLost);
    EXPECT_EQ(sequence.At(seen_again + kHalfASecond).estimate.status, Status::kOk);
    ExpectSameObjectFrame();
  }
}

TEST_P(Loss, ObjectThatComesBackElsewhereWithoutAMask_IsRecognisedWithinAFifthOfASecond) {
  // In a second it has moved by 0.2 m and turned: about its prediction a piece of it is seen.
  constexpr int kHidden = 100;
  constexpr int kSeenAgain = kHidden + 30;
  host::SimulationOptions options = Scene(GetParam(), kSeenAgain + 25);
  options.motion = host::MotionKind::kFast;
  options.mask = host::MaskKind::kNone;
  const TrackedSequence& sequence = Track(options, kSeenAgain + 25, [=](int i) {
    return i >= kHidden && i < kSeenAgain ? Fate::kBlank : Fate::kSeen;
  });
  EXPECT_EQ(sequence.At(kSeenAgain - 1).estimate.state, TrackingState::kLost);
  EXPECT_EQ(sequence.At(kSeenAgain + 6).estimate.status, Status::kOk);
  ExpectSameObjectFrame();
}

TEST_P(Loss, AnotherThingElsewhereWithoutAMask_IsNotTakenForItAndNoReasonToStartAnew) {
  constexpr float kRadius_m = 0.07F;  // as large as either object
  constexpr float kBehind_m = 0.5F;
  host::SimulationOptions options = Scene(GetParam(), 60);
  options.mask = host::MaskKind::kNone;
  TrackedSequence& sequence = Track(options, 60);
  ASSERT_EQ(sequence.last().estimate.state, TrackingState::kTracking);
  const Vec3 center_m(0.0F, 0.0F, sequence.last().estimate.T_co.translation().z() + kBehind_m);
  const std::vector<float> ball_m = DepthOfABall(options, center_m, kRadius_m);
  DepthFrame frame;
  host::Simulation later(options, host::MakeObjectMesh(options.object));
  later.Render(59, frame);
  frame.depth.data = ball_m.data();
  for (int i = 0; i < 120; ++i) {
    frame.stamp_ns += 33'333'333;
    const Estimate estimate = sequence.Offer(frame);
    EXPECT_NE(estimate.status, Status::kOk) << i;
    EXPECT_EQ(estimate.reset_counter, 0U) << i;
  }
}

TEST_P(Loss, AnotherObjectInItsPlace_IsNotTakenForIt) {
  OfferAnotherInItsPlace(host::MotionKind::kModerate,
                         [](int i, const Estimate& estimate, const host::Vec3d&) {
                           EXPECT_NE(estimate.status, Status::kOk) << i;
                         });
}

TEST_P(Loss, WhileItIsNotRecognised_ItIsSaidToBeWhereItsMaskIs) {
  // Another object in its place is never recognised, and is all that its mask shows.
  constexpr double kObject_m = 0.1;  // half of either
  OfferAnotherInItsPlace(
      host::MotionKind::kFlying, [&](int i, const Estimate& estimate, const host::Vec3d& truth_m) {
        EXPECT_EQ(estimate.status, Status::kRegistrationFailed) << i;
        EXPECT_LT((estimate.T_co.translation().cast<double>() - truth_m).norm(), kObject_m) << i;
      });
}

TEST_P(Loss, ObjectThatTurnedTooFar_IsStartedAnewOrRecognisedAsItLooks) {
  // A quarter turn goes unseen. Seed 1 shows too little of what was seen before, seed 4 enough.
  turn_deg_ = &TrackedFrame::off_from_alike_deg;
  host::SimulationOptions options = Scene(GetParam(), 300);
  options.motion = host::MotionKind::kRotate360;
  constexpr int kEnd = 20 + 75 + 60;
  for (const std::uint32_t seed : {1U, 4U}) {
    options.seed = seed;
    const TrackedSequence& sequence = Track(
        options, kEnd, [](int i) { return i >= 20 && i < 20 + 75 ? Fate::kDropped : Fate::kSeen; });
    EXPECT_EQ(sequence.last().estimate.state, TrackingState::kTracking) << seed;
    EXPECT_LE(sequence.last().estimate.reset_counter, 1) << seed;
    EXPECT_LT(sequence.last().off_m, 0.004) << seed;
    EXPECT_LT(sequence.last().off_from_alike_deg, 2.0) << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Loss, ::testing::Values(ObjectKind::kBox, ObjectKind::kBottle),
                         [](const ::testing::TestParamInfo<ObjectKind>& test) {
                           return test.param == ObjectKind::kBox ? "Box" : "Bottle";
                         });

}  // namespace
}  // namespace disflow::testing
