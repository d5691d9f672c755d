// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// @file
/// MAVLink's own messages, as far as DisFlow speaks them; see messages.h.

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

}  // namespace disflow::hal::mavlink
