// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "disflow/hal/mavlink/standard_messages.h"

/// @file
/// MAVLink's messages about time, and about where the object is for autopilots; see messages.h.

namespace disflow::hal::mavlink {

/// SYSTEM_TIME (#2): the same moment on two clocks of the sender.
struct SystemTime {
  static constexpr std::uint32_t kId = 2;
  static constexpr std::string_view kName = "SYSTEM_TIME";

  std::uint64_t time_unix_usec = 0;  ///< Since 1970; 0 = not known.
  std::uint32_t time_boot_ms = 0;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_unix_usec", message.time_unix_usec);
    field("time_boot_ms", message.time_boot_ms);
  }
};

/// TIMESYNC (#111): a question by whoever wants to know the other's clock, and its answer.
struct TimeSyncMessage {
  static constexpr std::uint32_t kId = 111;
  static constexpr std::string_view kName = "TIMESYNC";

  std::int64_t tc1 = 0;            ///< ns, on the clock of who answers; 0 in the question.
  std::int64_t ts1 = 0;            ///< ns, on the clock of who asks, when it asked.
  std::uint8_t target_system = 0;  ///< 0 = everybody, as with all who do not know this field.
  std::uint8_t target_component = 0;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("tc1", message.tc1);
    field("ts1", message.ts1);
    field("target_system", message.target_system, FieldKind::kExtension);
    field("target_component", message.target_component, FieldKind::kExtension);
  }
};

/// LANDING_TARGET (#149).
struct LandingTarget {
  static constexpr std::uint32_t kId = 149;
  static constexpr std::string_view kName = "LANDING_TARGET";

  static constexpr std::uint8_t kTypeVisionOther = 3;

  std::uint64_t time_usec = 0;  ///< Capture time.
  float angle_x = 0.0F;         ///< Off the middle of the image, to the right, rad.
  float angle_y = 0.0F;         ///< Downwards, rad.
  float distance = 0.0F;        ///< From the camera, m.
  float size_x = 0.0F;          ///< rad; 0 = not known.
  float size_y = 0.0F;
  std::uint8_t target_num = 0;
  std::uint8_t frame = 0;  ///< Of x, y, z and q.
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  std::array<float, 4> q{1.0F, 0.0F, 0.0F, 0.0F};  ///< w, x, y, z.
  std::uint8_t type = kTypeVisionOther;
  std::uint8_t position_valid = 0;  ///< x, y, z and q say something.

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("time_usec", message.time_usec);
    field("angle_x", message.angle_x);
    field("angle_y", message.angle_y);
    field("distance", message.distance);
    field("size_x", message.size_x);
    field("size_y", message.size_y);
    field("target_num", message.target_num);
    field("frame", message.frame);
    field("x", message.x, FieldKind::kExtension);
    field("y", message.y, FieldKind::kExtension);
    field("z", message.z, FieldKind::kExtension);
    field("q", message.q, FieldKind::kExtension);
    field("type", message.type, FieldKind::kExtension);
    field("position_valid", message.position_valid, FieldKind::kExtension);
  }
};

/// FOLLOW_TARGET (#144).
struct FollowTarget {
  static constexpr std::uint32_t kId = 144;
  static constexpr std::string_view kName = "FOLLOW_TARGET";

  static constexpr std::uint8_t kHasPosition = 1;  ///< Of est_capabilities.

  std::uint64_t timestamp = 0;  ///< Capture time, ms.
  std::uint64_t custom_state = 0;
  std::int32_t lat = 0;  ///< 1e-7 degrees, WGS84.
  std::int32_t lon = 0;
  float alt = 0.0F;            ///< Above sea level, m.
  std::array<float, 3> vel{};  ///< NaN: not known, as with those that follow.
  std::array<float, 3> acc{};
  std::array<float, 4> attitude_q{};
  std::array<float, 3> rates{};
  std::array<float, 3> position_cov{};  ///< Horizontal and vertical standard deviation, m.
  std::uint8_t est_capabilities = 0;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("timestamp", message.timestamp);
    field("custom_state", message.custom_state);
    field("lat", message.lat);
    field("lon", message.lon);
    field("alt", message.alt);
    field("vel", message.vel);
    field("acc", message.acc);
    field("attitude_q", message.attitude_q);
    field("rates", message.rates);
    field("position_cov", message.position_cov);
    field("est_capabilities", message.est_capabilities);
  }
};

/// GPS_GLOBAL_ORIGIN (#49): where on Earth the origin of the vehicle's local frame lies.
struct GpsGlobalOrigin {
  static constexpr std::uint32_t kId = 49;
  static constexpr std::string_view kName = "GPS_GLOBAL_ORIGIN";

  std::int32_t latitude = 0;  ///< 1e-7 degrees, WGS84.
  std::int32_t longitude = 0;
  std::int32_t altitude = 0;  ///< Above sea level, mm.
  std::uint64_t time_usec = 0;

  template <class Self, class Visitor>
  static constexpr void VisitFields(Self& message, Visitor& field) {
    field("latitude", message.latitude);
    field("longitude", message.longitude);
    field("altitude", message.altitude);
    field("time_usec", message.time_usec, FieldKind::kExtension);
  }
};

}  // namespace disflow::hal::mavlink
