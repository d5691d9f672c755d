// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// @file
/// The MAVLink messages that DisFlow speaks, field by field. docs/wire-format.md explains their
/// meaning and frames; docs/disflow.xml defines the private ones, DISFLOW_….
///
/// Every message lists its fields once, in wire order (base fields by falling size, then
/// extensions); payload size, checksum seed, encoder and decoder are all derived from that list.

namespace disflow::hal::mavlink {

/// Coordinate frames (MAV_FRAME) that DisFlow can name.
enum class MavFrame : std::uint8_t {
  kLocalNed = 1,
  kLocalEnu = 4,
  kBodyFrd = 12,  ///< x forward, y right, z down; the camera is the body.
  kLocalFrd = 20,
  kLocalFlu = 21,
};

/// Extension fields were added to a message after its first release and do not count in CRC_EXTRA.
enum class FieldKind : std::uint8_t { kBase, kExtension };

/// HEARTBEAT (#0).
struct Heartbeat {
  static constexpr std::uint32_t kId = 0;
  static constexpr std::string_view kName = "HEARTBEAT";

  static constexpr std::uint8_t kTypeOnboardController = 18;
  static constexpr std::uint8_t kAutopilotInvalid = 8;  ///< "Not a flight controller".
  static constexpr std::uint8_t kStateStandby = 3;
  static constexpr std::uint8_t kStateActive = 4;
  static constexpr std::uint8_t kMavlinkVersion = 3;

  std::uint32_t custom_mode = 0;  ///< TrackingState.
  std::uint8_t type = kTypeOnboardController;
  std::uint8_t autopilot = kAutopilotInvalid;
  std::uint8_t base_mode = 0;
  std::uint8_t system_status = kStateStandby;
  std::uint8_t mavlink_version = kMavlinkVersion;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("custom_mode", message.custom_mode);
    field("type", message.type);
    field("autopilot", message.autopilot);
    field("base_mode", message.base_mode);
    field("system_status", message.system_status);
    field("mavlink_version", message.mavlink_version);
  }
};

/// ODOMETRY (#331). Frames: docs/wire-format.md.
struct Odometry {
  static constexpr std::uint32_t kId = 331;
  static constexpr std::string_view kName = "ODOMETRY";

  static constexpr std::uint8_t kEstimatorVision = 2;
  static constexpr std::int8_t kQualityFailed = -1;
  static constexpr std::int8_t kQualityUnknown = 0;
  static constexpr int kCovarianceSize = 21;  ///< Upper triangle of a 6x6 matrix, row by row.

  std::uint64_t time_usec = 0;
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  std::array<float, 4> q{1.0F, 0.0F, 0.0F, 0.0F};  ///< w, x, y, z.
  float vx = 0.0F;
  float vy = 0.0F;
  float vz = 0.0F;
  float rollspeed = 0.0F;
  float pitchspeed = 0.0F;
  float yawspeed = 0.0F;
  std::array<float, kCovarianceSize> pose_covariance{};
  std::array<float, kCovarianceSize> velocity_covariance{};
  std::uint8_t frame_id = 0;
  std::uint8_t child_frame_id = 0;
  std::uint8_t reset_counter = 0;
  std::uint8_t estimator_type = kEstimatorVision;
  std::int8_t quality = kQualityUnknown;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_usec", message.time_usec);
    field("x", message.x);
    field("y", message.y);
    field("z", message.z);
    field("q", message.q);
    field("vx", message.vx);
    field("vy", message.vy);
    field("vz", message.vz);
    field("rollspeed", message.rollspeed);
    field("pitchspeed", message.pitchspeed);
    field("yawspeed", message.yawspeed);
    field("pose_covariance", message.pose_covariance);
    field("velocity_covariance", message.velocity_covariance);
    field("frame_id", message.frame_id);
    field("child_frame_id", message.child_frame_id);
    field("reset_counter", message.reset_counter, FieldKind::kExtension);
    field("estimator_type", message.estimator_type, FieldKind::kExtension);
    field("quality", message.quality, FieldKind::kExtension);
  }
};

/// DISFLOW_STATUS (#13721360 = 0xD15F10), private: see docs/disflow.xml.
struct DisflowStatus {
  static constexpr std::uint32_t kId = 0xD15F10;
  static constexpr std::string_view kName = "DISFLOW_STATUS";

  static constexpr std::uint32_t kAgeUnknown = 0xFFFFFFFF;

  std::uint64_t time_usec = 0;         ///< Capture time, as in ODOMETRY.
  float score = 0.0F;                  ///< Share of samples that the model explains, 0..1.
  float rms_m = 0.0F;                  ///< Root mean square of the inliers' distances.
  std::uint32_t age_us = kAgeUnknown;  ///< From capture to sending.
  // Totals since the tracker was constructed, so that a lost packet loses no count.
  std::uint32_t frames = 0;
  std::uint32_t dropped_frames = 0;  ///< Lost between sensor and tracker.
  std::uint32_t frames_rejected = 0;
  std::uint32_t frames_unregistered = 0;
  std::uint32_t observations_rejected = 0;
  std::uint32_t samples_dropped = 0;
  std::uint32_t samples_refused = 0;
  std::uint32_t clusters_evicted = 0;
  // Of this frame.
  std::uint16_t samples = 0;
  std::uint16_t inliers = 0;
  std::uint16_t edge_inliers = 0;
  std::uint16_t residuals_unmatched = 0;
  std::uint16_t residuals_truncated = 0;
  std::uint16_t residuals_normal_mismatch = 0;
  std::uint8_t state = 0;   ///< TrackingState.
  std::uint8_t status = 0;  ///< disflow::Status.
  std::uint8_t quality = 0;
  std::uint8_t reset_counter = 0;
  // Totals of the sensor, extension fields.
  std::uint32_t corrupt_frames = 0;
  std::uint16_t sensor_restarts = 0;
  std::uint16_t sensor_reconnects = 0;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_usec", message.time_usec);
    field("score", message.score);
    field("rms_m", message.rms_m);
    field("age_us", message.age_us);
    field("frames", message.frames);
    field("dropped_frames", message.dropped_frames);
    field("frames_rejected", message.frames_rejected);
    field("frames_unregistered", message.frames_unregistered);
    field("observations_rejected", message.observations_rejected);
    field("samples_dropped", message.samples_dropped);
    field("samples_refused", message.samples_refused);
    field("clusters_evicted", message.clusters_evicted);
    field("samples", message.samples);
    field("inliers", message.inliers);
    field("edge_inliers", message.edge_inliers);
    field("residuals_unmatched", message.residuals_unmatched);
    field("residuals_truncated", message.residuals_truncated);
    field("residuals_normal_mismatch", message.residuals_normal_mismatch);
    field("state", message.state);
    field("status", message.status);
    field("quality", message.quality);
    field("reset_counter", message.reset_counter);
    field("corrupt_frames", message.corrupt_frames, FieldKind::kExtension);
    field("sensor_restarts", message.sensor_restarts, FieldKind::kExtension);
    field("sensor_reconnects", message.sensor_reconnects, FieldKind::kExtension);
  }
};

/// DISFLOW_READY (#13721361 = 0xD15F11), private: a controller that gets its depth images over this
/// line can take the next one. Counts since it started.
struct DisflowReady {
  static constexpr std::uint32_t kId = 0xD15F11;
  static constexpr std::string_view kName = "DISFLOW_READY";

  std::uint32_t sequence = 0;         ///< Of the frame or poll that this answers; 0 = none yet.
  std::uint32_t frames = 0;           ///< Whole frames handed to the tracker.
  std::uint32_t frames_lost = 0;      ///< Begun, but not received whole.
  std::uint32_t frames_refused = 0;   ///< Larger than the memory for them, or without intrinsics.
  std::uint32_t packets = 0;          ///< With a correct checksum.
  std::uint32_t packets_corrupt = 0;  ///< What lay between two delimiters was no valid packet.
  std::uint32_t bytes_lost = 0;       ///< Arrived while the receive buffer was full.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("sequence", message.sequence);
    field("frames", message.frames);
    field("frames_lost", message.frames_lost);
    field("frames_refused", message.frames_refused);
    field("packets", message.packets);
    field("packets_corrupt", message.packets_corrupt);
    field("bytes_lost", message.bytes_lost);
  }
};

/// DISFLOW_TIMING (#13721362 = 0xD15F12), private: where a controller's time and stack went.
struct DisflowTiming {
  static constexpr std::uint32_t kId = 0xD15F12;
  static constexpr std::string_view kName = "DISFLOW_TIMING";
  static constexpr std::size_t kStages = 6;

  std::uint64_t time_usec = 0;                    ///< Capture time, as in ODOMETRY.
  std::uint64_t frame_ns = 0;                     ///< The tracker's whole work on this frame.
  std::array<std::uint64_t, kStages> stage_ns{};  ///< In the order of disflow::Stage.
  std::uint32_t stages_late = 0;                  ///< Stages beyond their budget, since the start.
  std::uint32_t restarts = 0;                     ///< By the watchdog or a fault, since power-on.
  std::uint32_t stack_bytes = 0;                  ///< High-water mark of the stack.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_usec", message.time_usec);
    field("frame_ns", message.frame_ns);
    field("stage_ns", message.stage_ns);
    field("stages_late", message.stages_late);
    field("restarts", message.restarts);
    field("stack_bytes", message.stack_bytes);
  }
};

/// DISFLOW_QUERY (#13721363 = 0xD15F13), private: asks for the distance field at points of the
/// object frame. Answered by DISFLOW_FIELD.
struct DisflowQuery {
  static constexpr std::uint32_t kId = 0xD15F13;
  static constexpr std::string_view kName = "DISFLOW_QUERY";
  static constexpr std::size_t kPoints = 10;

  std::uint32_t request = 0;  ///< Comes back with the answer.
  std::array<float, kPoints> x{};
  std::array<float, kPoints> y{};
  std::array<float, kPoints> z{};
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;  ///< Of the object; 0 = the first.
  std::uint8_t count = 0;             ///< Points used, 1 to kPoints.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("request", message.request);
    field("x", message.x);
    field("y", message.y);
    field("z", message.z);
    field("target_system", message.target_system);
    field("target_component", message.target_component);
    field("count", message.count);
  }
};

/// DISFLOW_FIELD (#13721364 = 0xD15F14), private: the answer to a DISFLOW_QUERY, point by point.
struct DisflowField {
  static constexpr std::uint32_t kId = 0xD15F14;
  static constexpr std::string_view kName = "DISFLOW_FIELD";
  static constexpr std::size_t kPoints = DisflowQuery::kPoints;

  std::uint64_t time_usec = 0;  ///< Capture time of the frame that the model has learnt from.
  std::uint32_t request = 0;
  std::array<float, kPoints> distance{};  ///< m; NaN: no answer for this point.
  std::array<float, kPoints> gradient_x{};
  std::array<float, kPoints> gradient_y{};
  std::array<float, kPoints> gradient_z{};
  std::array<float, kPoints> variance{};  ///< Of the distance, m^2.
  std::uint16_t in_bounds = 0;            ///< Bit i: surface was seen near point i.
  std::uint8_t count = 0;
  std::uint8_t status = 0;  ///< disflow::Status; kNotInitialised: there is no model.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_usec", message.time_usec);
    field("request", message.request);
    field("distance", message.distance);
    field("gradient_x", message.gradient_x);
    field("gradient_y", message.gradient_y);
    field("gradient_z", message.gradient_z);
    field("variance", message.variance);
    field("in_bounds", message.in_bounds);
    field("count", message.count);
    field("status", message.status);
  }
};

/// COMMAND_LONG (#76).
struct CommandLong {
  static constexpr std::uint32_t kId = 76;
  static constexpr std::string_view kName = "COMMAND_LONG";

  static constexpr std::uint16_t kCameraTrackPoint = 2004;  ///< x, y, radius; 0 to 1.
  static constexpr std::uint16_t kCameraTrackRectangle =
      2005;  ///< Left, top, right, bottom; 0 to 1.

  std::array<float, 7> param{};
  std::uint16_t command = 0;  ///< MAV_CMD
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  std::uint8_t confirmation = 0;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("param1", message.param[0]);
    field("param2", message.param[1]);
    field("param3", message.param[2]);
    field("param4", message.param[3]);
    field("param5", message.param[4]);
    field("param6", message.param[5]);
    field("param7", message.param[6]);
    field("command", message.command);
    field("target_system", message.target_system);
    field("target_component", message.target_component);
    field("confirmation", message.confirmation);
  }
};

/// COMMAND_ACK (#77).
struct CommandAck {
  static constexpr std::uint32_t kId = 77;
  static constexpr std::string_view kName = "COMMAND_ACK";

  static constexpr std::uint8_t kAccepted = 0;
  static constexpr std::uint8_t kDenied = 2;  ///< Known, but not allowed or without sense.
  static constexpr std::uint8_t kUnsupported = 3;
  static constexpr std::uint8_t kNoProgress = 255;

  std::uint16_t command = 0;  ///< MAV_CMD
  std::uint8_t result = kAccepted;
  std::uint8_t progress = kNoProgress;
  std::int32_t result_param2 = 0;
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("command", message.command);
    field("result", message.result);
    field("progress", message.progress, FieldKind::kExtension);
    field("result_param2", message.result_param2, FieldKind::kExtension);
    field("target_system", message.target_system, FieldKind::kExtension);
    field("target_component", message.target_component, FieldKind::kExtension);
  }
};

template <class... Messages>
struct MessageList {};

/// Every message that there is: no other is recognised by FrameDecoder or taken by EncodeFrame()
/// and DecodePayload(), so that one that is left out here does not compile.
using KnownMessages = MessageList<Heartbeat, Odometry, DisflowStatus, DisflowReady, DisflowTiming,
                                  DisflowQuery, DisflowField, CommandLong, CommandAck>;

}  // namespace disflow::hal::mavlink
