// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/estimate.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <set>
#include <string>

namespace disflow {
namespace {

constexpr std::uint32_t kMax = std::numeric_limits<std::uint32_t>::max();
using Raw = std::array<std::uint32_t, static_cast<std::size_t>(Counters::kCount)>;

Raw Sum(const Raw& a, const Raw& b) {
  auto total = std::bit_cast<Counters>(a);
  total.Accumulate(std::bit_cast<Counters>(b));
  return std::bit_cast<Raw>(total);
}

TEST(Counters, New_AreZero) { EXPECT_EQ(std::bit_cast<Raw>(Counters{}), Raw{}); }

TEST(Counters, EveryCounter_IsAddedToItselfAlone) {
  for (std::size_t i = 0; i < Raw{}.size(); ++i) {
    Raw start{};
    start.fill(1000);
    Raw more{};
    more[i] = 7;
    Raw expected = start;
    expected[i] = 1007;
    EXPECT_EQ(Sum(start, more), expected) << "counter " << i;
  }
}

TEST(Counters, EveryCounter_StopsAtItsMaximum) {
  for (std::size_t i = 0; i < Raw{}.size(); ++i) {
    Raw start{};
    start[i] = kMax - 3;
    Raw more{};
    more[i] = 3;
    EXPECT_EQ(Sum(start, more)[i], kMax) << "just reached, counter " << i;
    more[i] = 4;
    EXPECT_EQ(Sum(start, more)[i], kMax) << "one beyond, counter " << i;
    more[i] = kMax;
    EXPECT_EQ(Sum(start, more)[i], kMax) << "far beyond, counter " << i;
  }
}

TEST(TrackingState, EveryState_HasItsOwnName) {
  std::set<std::string> names{"unknown"};
  for (const TrackingState state :
       {TrackingState::kInitialising, TrackingState::kTracking, TrackingState::kDegraded,
        TrackingState::kLost, TrackingState::kRecovered}) {
    EXPECT_TRUE(names.insert(Name(state)).second) << Name(state);
  }
}

TEST(Stage, EveryStage_HasItsOwnName) {
  std::set<std::string> names{"unknown"};
  for (int i = 0; i < kStageCount; ++i) {
    EXPECT_TRUE(names.insert(Name(static_cast<Stage>(i))).second) << i;
  }
  EXPECT_STREQ(Name(static_cast<Stage>(kStageCount)), "unknown");
}

TEST(Estimate, New_ClaimsNothing) {
  const Estimate estimate;
  EXPECT_EQ(estimate.status, Status::kNotInitialised);
  EXPECT_EQ(estimate.quality, 0);
  EXPECT_FALSE(estimate.has_T_wo);
}

/// As the tracker leaves it after a registered frame.
Estimate Registered() {
  Estimate estimate;
  estimate.status = Status::kOk;
  estimate.state = TrackingState::kTracking;
  estimate.pose_covariance = 1e-6F * Mat6::Identity();
  estimate.quality = 90;
  return estimate;
}

TEST(EstimateKind, RegisteredFrame_IsMeasured) {
  Estimate estimate = Registered();
  for (const TrackingState state : {TrackingState::kInitialising, TrackingState::kTracking,
                                    TrackingState::kDegraded, TrackingState::kRecovered}) {
    estimate.state = state;
    EXPECT_EQ(KindOf(estimate), EstimateKind::kMeasured) << Name(state);
  }
}

TEST(EstimateKind, FrameThatWasNotRegistered_IsPredictedIfThereIsAModel) {
  for (const Status status :
       {Status::kRegistrationFailed, Status::kEmptyMask, Status::kNoValidDepth,
        Status::kTooFewSamples, Status::kMaskSizeMismatch, Status::kInvalidIntrinsics,
        Status::kImageTooLarge, Status::kInvalidTransform}) {
    Estimate estimate = Registered();
    estimate.status = status;
    EXPECT_EQ(KindOf(estimate), EstimateKind::kPredicted) << Describe(status);
    estimate.pose_covariance.setZero();
    EXPECT_EQ(KindOf(estimate), EstimateKind::kRefused) << "no model: " << Describe(status);
  }
}

TEST(EstimateKind, LostObject_IsNeverMeasured) {
  Estimate estimate = Registered();
  estimate.state = TrackingState::kLost;
  EXPECT_EQ(KindOf(estimate), EstimateKind::kPredicted);
}

TEST(EstimateKind, OldStampOrUnreadableFrame_IsRefused) {
  for (const Status status : {Status::kStampNotIncreasing, Status::kTruncated, Status::kCorrupt,
                              Status::kIoError, Status::kInvalidUri}) {
    Estimate estimate = Registered();
    estimate.status = status;
    EXPECT_EQ(KindOf(estimate), EstimateKind::kRefused) << Describe(status);
  }
  EXPECT_EQ(KindOf(Estimate{}), EstimateKind::kRefused);
}

TEST(EstimateKind, NumberThatIsNotFinite_IsRefused) {
  const Vec3 broken(0.0F, std::numeric_limits<float>::quiet_NaN(), 0.0F);
  Estimate pose = Registered();
  pose.T_co = {Mat3(Mat3::Identity()), broken};
  Estimate twist = Registered();
  twist.twist.linear_mps = broken;
  Estimate world = Registered();
  world.has_T_wo = true;
  world.T_wo = {Mat3(Mat3::Identity()), broken};
  for (const Estimate& estimate : {pose, twist, world}) {
    EXPECT_EQ(KindOf(estimate), EstimateKind::kRefused);
  }
}

TEST(EstimateKind, EveryKind_HasItsOwnName) {
  std::set<std::string> names{"unknown"};
  for (const EstimateKind kind :
       {EstimateKind::kMeasured, EstimateKind::kPredicted, EstimateKind::kRefused}) {
    EXPECT_TRUE(names.insert(Name(kind)).second) << Name(kind);
  }
}

TEST(Published, RefusedEstimate_HasNoMotionAndStaysRefused) {
  Estimate estimate = Registered();
  estimate.status = Status::kStampNotIncreasing;
  estimate.stamp_ns = 7;
  estimate.reset_counter = 3;
  const Estimate published = Published(estimate);
  EXPECT_FALSE(published.T_co.IsFinite());
  EXPECT_FALSE(published.has_T_wo);
  EXPECT_TRUE(published.twist.linear_mps.array().isNaN().all());
  EXPECT_TRUE(published.twist.angular_rps.array().isNaN().all());
  EXPECT_TRUE(published.pose_covariance.array().isNaN().all());
  EXPECT_TRUE(published.twist_covariance.array().isNaN().all());
  EXPECT_EQ(published.quality, 0);
  EXPECT_EQ(published.status, Status::kStampNotIncreasing);
  EXPECT_EQ(published.stamp_ns, 7);
  EXPECT_EQ(published.reset_counter, 3);
  EXPECT_EQ(KindOf(published), EstimateKind::kRefused);
}

TEST(Published, MeasuredAndPredictedEstimates_AreAsTheyWere) {
  for (const Status status : {Status::kOk, Status::kRegistrationFailed}) {
    Estimate estimate = Registered();
    estimate.status = status;
    estimate.T_co = {Mat3(Mat3::Identity()), Vec3(1.0F, 2.0F, 3.0F)};
    const Estimate published = Published(estimate);
    EXPECT_EQ(published.T_co.translation(), estimate.T_co.translation());
    EXPECT_EQ(published.pose_covariance, estimate.pose_covariance);
    EXPECT_EQ(published.quality, 90);
  }
}

}  // namespace
}  // namespace disflow
