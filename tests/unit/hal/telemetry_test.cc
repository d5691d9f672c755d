// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/telemetry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "wire_samples.h"

namespace disflow::hal::mavlink::testing {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

Estimate Tracked() {
  Estimate estimate;
  estimate.status = Status::kOk;
  estimate.state = TrackingState::kTracking;
  estimate.stamp_ns = 1'234'567'891;
  estimate.quality = 90;
  estimate.pose_covariance = Mat6::Identity() * 1e-6F;
  estimate.twist_covariance = Mat6::Identity() * 1e-4F;
  return estimate;
}

Odometry Sent(const Estimate& estimate) { return MakeOdometry(estimate, MavFrame::kBodyFrd); }

TEST(Telemetry, CaptureTime_IsCutToMicroseconds) {
  EXPECT_EQ(Sent(Tracked()).time_usec, 1'234'567U);
  EXPECT_EQ(MakeStatus(Tracked(), {}).time_usec, 1'234'567U);
}

TEST(Telemetry, NegativeStamp_BecomesZeroInsteadOfTheFarFuture) {
  Estimate estimate = Tracked();
  estimate.stamp_ns = -1;
  EXPECT_EQ(Sent(estimate).time_usec, 0U);
}

TEST(Telemetry, MeasuredPose_HasMavlinksQuality) {
  Estimate estimate = Tracked();
  EXPECT_EQ(Sent(estimate).quality, 90);
  estimate.quality = 255;
  EXPECT_EQ(Sent(estimate).quality, 100);
  estimate.quality = 0;
  EXPECT_EQ(Sent(estimate).quality, Odometry::kQualityUnknown);
}

TEST(Telemetry, PredictedPose_IsSentAsFailedWithItsCovariance) {
  // Its quality is still above 0 in the first frames after the last measured one.
  for (const Status status : {Status::kRegistrationFailed, Status::kEmptyMask,
                              Status::kInvalidIntrinsics, Status::kMaskSizeMismatch}) {
    Estimate estimate = Tracked();
    estimate.status = status;
    estimate.T_co = {Mat3(Mat3::Identity()), Vec3(0.0F, 0.0F, 0.7F)};
    const Odometry odometry = Sent(estimate);
    EXPECT_EQ(odometry.quality, Odometry::kQualityFailed) << Describe(status);
    EXPECT_EQ(odometry.time_usec, 1'234'567U);
    EXPECT_EQ(odometry.x, 0.7F);
    EXPECT_FLOAT_EQ(odometry.pose_covariance[0], 1e-6F);
    EXPECT_EQ(MakeStatus(estimate, {}).quality, 90);
  }
}

TEST(Telemetry, LostObject_HasFailedQuality) {
  Estimate estimate = Tracked();
  estimate.state = TrackingState::kLost;
  EXPECT_EQ(Sent(estimate).quality, Odometry::kQualityFailed);
}

void ExpectNoMotionIsSaid(const Odometry& odometry) {
  EXPECT_EQ(odometry.quality, Odometry::kQualityFailed);
  for (const float value : {odometry.x, odometry.y, odometry.z, odometry.q[0], odometry.q[1],
                            odometry.q[2], odometry.q[3], odometry.vx, odometry.vy, odometry.vz,
                            odometry.rollspeed, odometry.pitchspeed, odometry.yawspeed,
                            odometry.pose_covariance[0], odometry.velocity_covariance[0]}) {
    EXPECT_TRUE(std::isnan(value)) << value;
  }
}

TEST(Telemetry, RefusedFrame_LeavesWithoutAPose) {
  // A stamp that was there before, and frames that could not be read.
  for (const Status status : {Status::kStampNotIncreasing, Status::kTruncated, Status::kCorrupt}) {
    Estimate estimate = Tracked();
    estimate.status = status;
    estimate.has_T_wo = true;
    ExpectNoMotionIsSaid(Sent(estimate));
    ExpectNoMotionIsSaid(MakeOdometry(estimate, MavFrame::kLocalFrd));
    const DisflowStatus said = MakeStatus(estimate, {});
    EXPECT_EQ(said.status, static_cast<std::uint8_t>(status));
    EXPECT_EQ(said.quality, 0);
  }
}

TEST(Telemetry, FrameBeforeThereIsAModel_LeavesWithoutAPose) {
  Estimate estimate;
  estimate.status = Status::kEmptyMask;
  ExpectNoMotionIsSaid(Sent(estimate));
}

TEST(Telemetry, PoseOrTwistThatIsNoNumber_LeavesWithoutAPose) {
  Estimate pose = Tracked();
  pose.T_co = {Mat3(Mat3::Identity()), Vec3(0.0F, kNaN, 0.0F)};
  ExpectNoMotionIsSaid(Sent(pose));
  Estimate twist = Tracked();
  twist.twist.angular_rps.z() = kNaN;
  ExpectNoMotionIsSaid(Sent(twist));
}

TEST(Telemetry, KnownCovariance_HasNumbersOnly) {
  const Odometry odometry = Sent(Tracked());
  for (const float value : odometry.pose_covariance) EXPECT_TRUE(std::isfinite(value));
  for (const float value : odometry.velocity_covariance) EXPECT_TRUE(std::isfinite(value));
}

TEST(Telemetry, UnusableCovariance_IsMarkedUnknownByNaNInItsFirstElement) {
  Mat6 with_nan = Mat6::Identity();
  with_nan(5, 2) = kNaN;
  Mat6 negative = Mat6::Identity();
  negative(3, 3) = -1.0F;
  for (const Mat6& covariance : {Mat6(Mat6::Zero()), with_nan, negative}) {
    Estimate estimate = Tracked();
    estimate.pose_covariance = covariance;
    estimate.twist_covariance = covariance;
    const Odometry odometry = Sent(estimate);
    EXPECT_TRUE(std::isnan(odometry.pose_covariance[0]));
    EXPECT_TRUE(std::isnan(odometry.velocity_covariance[0]));
  }
}

TEST(Telemetry, ObjectAlignedWithTheCamera_HasTheFixedRotationFromOpticalToBodyAxes) {
  // docs/wire-format.md promises it.
  const std::array<float, 4> expected{0.5F, 0.5F, 0.5F, 0.5F};
  EXPECT_EQ(Sent(Tracked()).q, expected);
}

TEST(Telemetry, WorldPoseAskedForButNotKnown_FallsBackToTheCameraAndSaysSo) {
  EXPECT_EQ(MakeOdometry(Tracked(), MavFrame::kLocalFrd).frame_id, 12);
}

TEST(Telemetry, Status_CarriesStateCountersAndTotals) {
  Estimate estimate = Tracked();
  estimate.state = TrackingState::kRecovered;
  estimate.status = Status::kRegistrationFailed;
  estimate.reset_counter = 3;
  estimate.samples = 500;
  estimate.inliers = 400;
  estimate.edge_inliers = 30;
  estimate.score = 0.8F;
  estimate.rms_m = 0.002F;
  estimate.rejected.residuals_unmatched = 11;
  estimate.rejected.residuals_truncated = 12;
  estimate.rejected.residuals_normal_mismatch = 13;
  SendContext context;
  context.age_ns = 4'321'999;
  context.sensor.dropped = 2;
  context.sensor.corrupt = 9;
  context.sensor.restarts = 70000;
  context.sensor.reconnects = 11;
  context.totals.frames = 100;
  context.totals.frames_rejected = 5;
  context.totals.frames_unregistered = 6;
  context.totals.observations_rejected = 7;
  context.totals.samples_dropped = 8;
  context.totals.samples_refused = 9;
  context.totals.clusters_evicted = 10;
  const DisflowStatus status = MakeStatus(estimate, context);
  EXPECT_EQ(status.state, 4);
  EXPECT_EQ(status.status, 17);
  EXPECT_EQ(status.quality, 90);
  EXPECT_EQ(status.reset_counter, 3);
  EXPECT_EQ(status.samples, 500);
  EXPECT_EQ(status.inliers, 400);
  EXPECT_EQ(status.edge_inliers, 30);
  EXPECT_FLOAT_EQ(status.score, 0.8F);
  EXPECT_FLOAT_EQ(status.rms_m, 0.002F);
  EXPECT_EQ(status.residuals_unmatched, 11);
  EXPECT_EQ(status.residuals_truncated, 12);
  EXPECT_EQ(status.residuals_normal_mismatch, 13);
  EXPECT_EQ(status.age_us, 4321U);
  EXPECT_EQ(status.dropped_frames, 2U);
  EXPECT_EQ(status.corrupt_frames, 9U);
  EXPECT_EQ(status.sensor_restarts, 65535);
  EXPECT_EQ(status.sensor_reconnects, 11);
  EXPECT_EQ(status.frames, 100U);
  EXPECT_EQ(status.frames_rejected, 5U);
  EXPECT_EQ(status.frames_unregistered, 6U);
  EXPECT_EQ(status.observations_rejected, 7U);
  EXPECT_EQ(status.samples_dropped, 8U);
  EXPECT_EQ(status.samples_refused, 9U);
  EXPECT_EQ(status.clusters_evicted, 10U);
}

TEST(Telemetry, CountersAndAge_SaturateInsteadOfWrapping) {
  Estimate estimate = Tracked();
  estimate.rejected.residuals_unmatched = 65'536;
  SendContext context;
  context.age_ns = std::numeric_limits<std::int64_t>::max();
  const DisflowStatus status = MakeStatus(estimate, context);
  EXPECT_EQ(status.residuals_unmatched, 65'535);
  EXPECT_EQ(status.age_us, DisflowStatus::kAgeUnknown - 1);
}

TEST(Telemetry, NegativeAge_IsUnknown) {
  SendContext context;
  context.age_ns = -5;
  EXPECT_EQ(MakeStatus(Tracked(), context).age_us, DisflowStatus::kAgeUnknown);
}

TEST(Telemetry, Heartbeat_IsActiveWhileThereIsAPose) {
  EXPECT_EQ(MakeHeartbeat(TrackingState::kInitialising).system_status, Heartbeat::kStateStandby);
  EXPECT_EQ(MakeHeartbeat(TrackingState::kTracking).system_status, Heartbeat::kStateActive);
  EXPECT_EQ(MakeHeartbeat(TrackingState::kDegraded).system_status, Heartbeat::kStateActive);
  EXPECT_EQ(MakeHeartbeat(TrackingState::kLost).system_status, Heartbeat::kStateStandby);
  EXPECT_EQ(MakeHeartbeat(TrackingState::kRecovered).system_status, Heartbeat::kStateActive);
  EXPECT_EQ(MakeHeartbeat(TrackingState::kLost).custom_mode, 3U);
}

TEST(TelemetryEncoder, Frames_AreNumberedAndSignedByTheObjectsComponent) {
  TelemetryOptions options;
  options.object_index = 2;
  TelemetryEncoder encoder(options);
  FrameDecoder decoder;
  Bytes buffer(kMaxFrameSize);
  for (int i = 0; i < 300; ++i) {
    const auto size = encoder.EncodeHeartbeat(TrackingState::kTracking, buffer);
    ASSERT_TRUE(size.ok());
    const auto frames = DecodeAll(decoder, std::span(buffer).first(size.value));
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].view.header.sequence, i % 256);
    EXPECT_EQ(frames[0].view.header.system_id, 190);
    EXPECT_EQ(frames[0].view.header.component_id, 27);
  }
}

TEST(TelemetryEncoder, AllMessages_ShareOneNumbering) {
  TelemetryEncoder encoder;
  Bytes buffer(kMaxFrameSize);
  ASSERT_TRUE(encoder.EncodeOdometry(Tracked(), buffer).ok());
  EXPECT_EQ(std::to_integer<int>(buffer[4]), 0);
  ASSERT_TRUE(encoder.EncodeStatus(Tracked(), {}, buffer).ok());
  EXPECT_EQ(std::to_integer<int>(buffer[4]), 1);
  ASSERT_TRUE(encoder.EncodeHeartbeat(TrackingState::kLost, buffer).ok());
  EXPECT_EQ(std::to_integer<int>(buffer[4]), 2);
}

TEST(TelemetryEncoder, RefusedFrame_UsesUpNoNumber) {
  TelemetryEncoder encoder;
  Bytes small(10);
  EXPECT_EQ(encoder.EncodeOdometry(Tracked(), small).status, Status::kCapacityExceeded);
  Bytes buffer(kMaxFrameSize);
  ASSERT_TRUE(encoder.EncodeOdometry(Tracked(), buffer).ok());
  EXPECT_EQ(std::to_integer<int>(buffer[4]), 0);
}

TEST(TelemetryOptions, Defaults_AreValid) { EXPECT_TRUE(Validate(TelemetryOptions{}).ok()); }

TEST(TelemetryOptions, WrongOnes_AreNamed) {
  const auto message_of = [](const TelemetryOptions& options) {
    const Fault fault = Validate(options);
    EXPECT_EQ(fault.status, Status::kInvalidConfig);
    return std::string(fault.message);
  };
  EXPECT_NE(message_of({.system_id = 0}).find("system id"), std::string::npos);
  EXPECT_NE(message_of({.object_index = 43}).find("object index is 43"), std::string::npos);
  EXPECT_NE(message_of({.pose_frame = static_cast<MavFrame>(2)}).find("pose frame is 2"),
            std::string::npos);
}

}  // namespace
}  // namespace disflow::hal::mavlink::testing
