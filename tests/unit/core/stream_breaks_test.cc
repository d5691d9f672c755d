// SPDX-License-Identifier: BSD-3-Clause
// What becomes of the object, and of what is said of it, when the stream of images breaks off.
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "disflow/tracker.h"
#include "traced_scene.h"

namespace disflow::testing {
namespace {

using MicroTracker = Tracker<profiles::Micro>;

/// A tracker before a thing at rest, the clock of whose camera is set as one likes.
class StreamBreaks : public ::testing::Test {
 protected:
  static constexpr StampNs kFrame_ns = 33'333'333;
  static constexpr StampNs kStart_ns = 500'000'000'000;

  Estimate GiveAt(StampNs stamp_ns) {
    DepthFrame frame = thing_.frame();
    frame.stamp_ns = stamp_ns;
    return Give(frame);
  }
  Estimate Give(const DepthFrame& frame) {
    Estimate estimate;
    EXPECT_EQ(tracker_->Process(frame, estimate), estimate.status);
    return estimate;
  }
  /// Until the object is tracked. @return The stamp of the last frame.
  StampNs Track(StampNs from_ns) {
    constexpr int kFrames = 12;
    for (int i = 0; i < kFrames; ++i) (void)GiveAt(from_ns + i * kFrame_ns);
    return from_ns + (kFrames - 1) * kFrame_ns;
  }
  /// Frames of `span_ns` of time. @return How many were refused for their stamps.
  int RefusedFrom(StampNs from_ns, StampNs span_ns) {
    int refused = 0;
    for (StampNs at_ns = 0; at_ns <= span_ns; at_ns += kFrame_ns)
      refused += GiveAt(from_ns + at_ns).status == Status::kStampNotIncreasing ? 1 : 0;
    return refused;
  }

  DepthScene thing_ = DepthScene(1.2F).Rectangle({40, 30, 110, 90}, 0.5F);
  std::unique_ptr<MicroTracker> tracker_ = std::make_unique<MicroTracker>();
};

TEST_F(StreamBreaks, ClockThatIsSetBackForGood_CostsTwoSecondsAndTheObject) {
  (void)Track(kStart_ns);
  const int refused = RefusedFrom(0, 5'000'000'000);
  EXPECT_GE(refused, 60);
  EXPECT_LE(refused, 62);
  const Estimate estimate = GiveAt(6'000'000'000);
  EXPECT_EQ(estimate.stamp_ns, 6'000'000'000);
  EXPECT_EQ(estimate.reset_counter, 1);
  EXPECT_FALSE(tracker_->field().empty());
}

TEST_F(StreamBreaks, ClockThatIsPutRightWithinTwoSeconds_CostsItsFramesAndNoObject) {
  const StampNs last_ns = Track(kStart_ns);
  EXPECT_EQ(RefusedFrom(0, 1'900'000'000), 58);
  EXPECT_EQ(RefusedFrom(last_ns + kFrame_ns, 500'000'000), 0);
  EXPECT_EQ(GiveAt(last_ns + 600'000'000).reset_counter, 0);
}

TEST_F(StreamBreaks, OldFramesBetweenNewOnes_AreNoClock) {
  StampNs now_ns = Track(kStart_ns);
  for (int i = 0; i < 100; ++i) {
    now_ns += kFrame_ns;
    EXPECT_EQ(GiveAt(now_ns).status, Status::kOk);
    EXPECT_EQ(GiveAt(i * kFrame_ns).status, Status::kStampNotIncreasing);
  }
  EXPECT_EQ(GiveAt(now_ns + kFrame_ns).reset_counter, 0);
}

TEST_F(StreamBreaks, OneStampFarAhead_EndsNothingForLongerThanTwoSeconds) {
  StampNs now_ns = Track(kStart_ns);
  (void)GiveAt(std::numeric_limits<StampNs>::max());
  EXPECT_LE(RefusedFrom(now_ns + kFrame_ns, 4'000'000'000), 62);
}

TEST_F(StreamBreaks, ResetByHand_TakesAnyStampNext) {
  (void)Track(kStart_ns);
  tracker_->Reset();
  EXPECT_EQ(GiveAt(17).status, Status::kOk);
  EXPECT_EQ(GiveAt(17).status, Status::kStampNotIncreasing);
}

TEST_F(StreamBreaks, FramesThatAreRefusedForLong_AreNoTracking) {
  StampNs now_ns = Track(kStart_ns);
  EXPECT_EQ(GiveAt(now_ns += kFrame_ns).state, TrackingState::kTracking);
  DepthFrame frame = thing_.frame();
  frame.depth.data = nullptr;
  frame.stamp_ns = now_ns + kFrame_ns;
  EXPECT_EQ(Give(frame).state, TrackingState::kTracking) << "one frame is nothing";
  frame.stamp_ns = now_ns + 1'000'000'000;
  const Estimate refused = Give(frame);
  EXPECT_EQ(refused.state, TrackingState::kLost);
  EXPECT_EQ(refused.quality, 0);
  // The tracker's own state is as it was.
  EXPECT_EQ(GiveAt(now_ns + kFrame_ns).state, TrackingState::kTracking);
}

TEST_F(StreamBreaks, FrameThatEndsTheSearch_IsStillOfTheObjectBefore) {
  StampNs now_ns = Track(kStart_ns);
  Estimate before;
  Estimate estimate;
  DepthScene other_thing(0.9F);
  DepthFrame frame = other_thing.Rectangle({10, 10, 30, 100}, 0.5F).frame();
  for (int i = 0; i < 600 && !tracker_->field().empty(); ++i) {
    // In view but not found, so that it is given up in the end.
    frame.stamp_ns = now_ns += kFrame_ns;
    before = estimate;
    estimate = Give(frame);
  }
  ASSERT_TRUE(tracker_->field().empty());
  EXPECT_EQ(estimate.reset_counter, before.reset_counter);
  EXPECT_EQ(GiveAt(now_ns + kFrame_ns).reset_counter, before.reset_counter + 1);
}

TEST_F(StreamBreaks, LabelWithoutMask_LeavesNoPixelsOfTheFrameBefore) {
  const StampNs last_ns = Track(kStart_ns);
  EXPECT_GT(tracker_->last_mask().count(), 0);
  tracker_->Reset();
  DepthFrame frame = thing_.frame();
  frame.stamp_ns = last_ns + kFrame_ns;
  frame.mask.label = 3;
  EXPECT_EQ(Give(frame).status, Status::kEmptyMask);
  EXPECT_EQ(tracker_->last_mask().count(), 0);
}

TEST_F(StreamBreaks, KnownPoseThatIsNoRigidMotion_IsRefused) {
  DepthFrame frame = thing_.frame();
  frame.stamp_ns = kStart_ns;
  Estimate estimate;
  for (const Mat3& no_rotation : {Mat3(Mat3::Zero()), Mat3(2.0F * Mat3::Identity()),
                                  Mat3(Vec3(1.0F, 1.0F, -1.0F).asDiagonal())}) {
    EXPECT_EQ(tracker_->Fuse(frame, {no_rotation, Vec3(Vec3::Zero())}, estimate),
              Status::kInvalidTransform);
  }
  EXPECT_TRUE(tracker_->field().empty());
  EXPECT_EQ(tracker_->Fuse(frame, {}, estimate), Status::kOk);
}

}  // namespace
}  // namespace disflow::testing
