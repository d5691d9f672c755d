// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/telemetry.h"

#include <algorithm>
#include <limits>

#include "disflow/geometry/covariance.h"

namespace disflow::hal::mavlink {
namespace {

using Covariance = std::array<float, Odometry::kCovarianceSize>;

constexpr std::int64_t kNsPerUs = 1000;

/// Optical axes (x right, y down, z forward) to the body's (x forward, y right, z down).
Mat3 RotationFrdFromOptical() noexcept {
  Mat3 rotation;
  rotation << 0.0F, 0.0F, 1.0F,  //
      1.0F, 0.0F, 0.0F,          //
      0.0F, 1.0F, 0.0F;
  return rotation;
}

/// Upper triangle, row by row, of the covariance with both of its 3-vectors rotated. A covariance
/// that was never set or is not finite becomes MAVLink's "unknown".
Covariance RotatedUpperTriangle(const Mat3& rotation, const Mat6& covariance) noexcept {
  Covariance packed{};
  if (!covariance.allFinite() || covariance.diagonal().minCoeff() < 0.0F ||
      covariance.diagonal().maxCoeff() == 0.0F) {
    packed[0] = std::numeric_limits<float>::quiet_NaN();
    return packed;
  }
  const Mat6 rotated = RotatedCovariance(covariance, rotation);
  std::size_t next = 0;
  for (int row = 0; row < 6; ++row) {
    for (int col = row; col < 6; ++col) packed[next++] = rotated(row, col);
  }
  return packed;
}

/// ODOMETRY has this byte alone to tell a measurement from the rest.
std::int8_t QualityOf(const Estimate& estimate) noexcept {
  constexpr std::uint8_t kBestQuality = 100;
  if (KindOf(estimate) != EstimateKind::kMeasured) return Odometry::kQualityFailed;
  return static_cast<std::int8_t>(std::min(estimate.quality, kBestQuality));
}

std::uint16_t Saturated16(std::uint32_t count) noexcept {
  constexpr std::uint32_t kMax = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(count, kMax));
}

std::uint32_t AgeOf(std::int64_t age_ns) noexcept {
  if (age_ns < 0) return DisflowStatus::kAgeUnknown;
  constexpr std::int64_t kMax = std::int64_t{DisflowStatus::kAgeUnknown} - 1;
  return static_cast<std::uint32_t>(std::min(age_ns / kNsPerUs, kMax));
}

void SetPosition(const Vec3& position_m, Odometry& odometry) noexcept {
  odometry.x = position_m.x();
  odometry.y = position_m.y();
  odometry.z = position_m.z();
}

void SetRotation(const Mat3& rotation, Odometry& odometry) noexcept {
  Eigen::Quaternion<float, Eigen::DontAlign> q(rotation);
  q.normalize();
  if (q.w() < 0.0F) q.coeffs() = -q.coeffs();
  odometry.q = {q.w(), q.x(), q.y(), q.z()};
}

void SetTwist(const Twist& twist, const Mat3& rotation, Odometry& odometry) noexcept {
  const Vec3 linear_mps = rotation * twist.linear_mps;
  const Vec3 angular_rps = rotation * twist.angular_rps;
  odometry.vx = linear_mps.x();
  odometry.vy = linear_mps.y();
  odometry.vz = linear_mps.z();
  odometry.rollspeed = angular_rps.x();
  odometry.pitchspeed = angular_rps.y();
  odometry.yawspeed = angular_rps.z();
}

}  // namespace

std::uint64_t MicrosecondsOf(StampNs stamp_ns) noexcept {
  return stamp_ns < 0 ? 0 : static_cast<std::uint64_t>(stamp_ns / kNsPerUs);
}

Fault Validate(const TelemetryOptions& options) noexcept {
  if (options.system_id == 0) {
    return MakeFault(Status::kInvalidConfig,
                     "telemetry system id is 0, which means \"everybody\"; use 1 to 255, but not "
                     "your autopilot's");
  }
  if (options.object_index > kMaxObjectIndex) {
    return MakeFault(Status::kInvalidConfig, "telemetry object index is %d; allowed are 0 to %d",
                     options.object_index, kMaxObjectIndex);
  }
  switch (options.pose_frame) {
    case MavFrame::kLocalNed:
    case MavFrame::kLocalEnu:
    case MavFrame::kBodyFrd:
    case MavFrame::kLocalFrd:
    case MavFrame::kLocalFlu:
      return {};
  }
  return MakeFault(Status::kInvalidConfig,
                   "telemetry pose frame is %d; allowed are 1 (local NED), 4 (local ENU), 12 "
                   "(camera, FRD), 20 (local FRD) and 21 (local FLU)",
                   static_cast<int>(options.pose_frame));
}

Odometry MakeOdometry(const Estimate& tracked, MavFrame pose_frame) noexcept {
  const Estimate estimate = Published(tracked);
  const Mat3 R_fc = RotationFrdFromOptical();
  Odometry odometry;
  odometry.time_usec = MicrosecondsOf(estimate.stamp_ns);
  odometry.child_frame_id = static_cast<std::uint8_t>(MavFrame::kBodyFrd);
  odometry.reset_counter = estimate.reset_counter;
  odometry.quality = QualityOf(estimate);

  if (pose_frame != MavFrame::kBodyFrd && estimate.has_T_wo) {
    odometry.frame_id = static_cast<std::uint8_t>(pose_frame);
    SetPosition(estimate.T_wo.translation(), odometry);
    SetRotation(estimate.T_wo.rotation(), odometry);
    const Mat3 R_wc = estimate.T_wo.rotation() * estimate.T_co.rotation().transpose();
    odometry.pose_covariance = RotatedUpperTriangle(R_wc, estimate.pose_covariance);
  } else {
    odometry.frame_id = static_cast<std::uint8_t>(MavFrame::kBodyFrd);
    SetPosition(R_fc * estimate.T_co.translation(), odometry);
    SetRotation(R_fc * estimate.T_co.rotation(), odometry);
    odometry.pose_covariance = RotatedUpperTriangle(R_fc, estimate.pose_covariance);
  }
  SetTwist(estimate.twist, R_fc, odometry);
  odometry.velocity_covariance = RotatedUpperTriangle(R_fc, estimate.twist_covariance);
  return odometry;
}

DisflowStatus MakeStatus(const Estimate& estimate, const SendContext& context) noexcept {
  const Counters& frame = estimate.rejected;
  const Counters& totals = context.totals;
  DisflowStatus status;
  status.time_usec = MicrosecondsOf(estimate.stamp_ns);
  status.score = estimate.score;
  status.rms_m = estimate.rms_m;
  status.age_us = AgeOf(context.age_ns);
  status.frames = totals.frames;
  status.dropped_frames = context.sensor.dropped;
  status.frames_rejected = totals.frames_rejected;
  status.frames_unregistered = totals.frames_unregistered;
  status.observations_rejected = totals.observations_rejected;
  status.samples_dropped = totals.samples_dropped;
  status.samples_refused = totals.samples_refused;
  status.clusters_evicted = totals.clusters_evicted;
  status.samples = estimate.samples;
  status.inliers = estimate.inliers;
  status.edge_inliers = estimate.edge_inliers;
  status.residuals_unmatched = Saturated16(frame.residuals_unmatched);
  status.residuals_truncated = Saturated16(frame.residuals_truncated);
  status.residuals_normal_mismatch = Saturated16(frame.residuals_normal_mismatch);
  status.state = static_cast<std::uint8_t>(estimate.state);
  status.status = static_cast<std::uint8_t>(estimate.status);
  status.quality = KindOf(estimate) == EstimateKind::kRefused ? std::uint8_t{0} : estimate.quality;
  status.reset_counter = estimate.reset_counter;
  status.corrupt_frames = context.sensor.corrupt;
  status.sensor_restarts = Saturated16(context.sensor.restarts);
  status.sensor_reconnects = Saturated16(context.sensor.reconnects);
  return status;
}

Heartbeat MakeHeartbeat(TrackingState state) noexcept {
  const bool has_pose = state == TrackingState::kTracking || state == TrackingState::kDegraded ||
                        state == TrackingState::kRecovered;
  Heartbeat heartbeat;
  heartbeat.custom_mode = static_cast<std::uint32_t>(state);
  heartbeat.system_status = has_pose ? Heartbeat::kStateActive : Heartbeat::kStateStandby;
  return heartbeat;
}

SystemTime MakeSystemTime(std::int64_t boot_ns, std::int64_t epoch_ns) noexcept {
  constexpr std::int64_t k2015_ns = 1'420'070'400'000'000'000;
  SystemTime time;
  if (epoch_ns >= k2015_ns) time.time_unix_usec = MicrosecondsOf(epoch_ns);
  // After 49 days it begins anew, as all such counts do.
  time.time_boot_ms = static_cast<std::uint32_t>(MicrosecondsOf(boot_ns) / 1000);
  return time;
}

}  // namespace disflow::hal::mavlink
