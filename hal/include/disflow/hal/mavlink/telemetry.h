// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow/estimate.h"
#include "disflow/hal/depth_sensor.h"
#include "disflow/hal/fault.h"
#include "disflow/hal/mavlink/frame.h"

/// @file
/// From the tracker's Estimate to MAVLink messages. Frames and fields: docs/wire-format.md.

namespace disflow::hal::mavlink {

struct TelemetryOptions {
  /// Never an autopilot's (those use 1 by default): autopilots take ODOMETRY of their own system as
  /// their own motion.
  std::uint8_t system_id = 190;
  /// The component is MAV_COMP_ID_USER1 (25) + object_index.
  std::uint8_t object_index = 0;
  /// kBodyFrd: ODOMETRY carries the pose in the camera (T_co). Any other: it carries the pose in
  /// the caller's world (T_wo), whose axes must be what this name says, whenever the estimate has
  /// one.
  MavFrame pose_frame = MavFrame::kBodyFrd;
};

inline constexpr std::uint8_t kFirstComponentId = 25;
inline constexpr std::uint8_t kMaxObjectIndex = 42;  ///< MAV_COMP_ID_USER43, the last in a row.

/// @return kInvalidConfig with the option's name, value and allowed range.
[[nodiscard]] Fault Validate(const TelemetryOptions& options) noexcept;

/// What DISFLOW_STATUS says beyond the Estimate.
struct SendContext {
  std::int64_t age_ns = -1;  ///< Now minus capture stamp; negative = unknown.
  SensorCounters sensor;
  Counters totals;  ///< Tracker::totals().
};

/// A capture stamp as messages carry it; 0 for what lies before the clock's start.
[[nodiscard]] std::uint64_t MicrosecondsOf(StampNs stamp_ns) noexcept;

/// Pose and twist with a quality from 0 to 100 if they were measured, and with -1 if they are only
/// predicted; NaN and -1 if the estimate was refused, see EstimateKind.
/// @param pose_frame See TelemetryOptions.
[[nodiscard]] Odometry MakeOdometry(const Estimate& tracked, MavFrame pose_frame) noexcept;
[[nodiscard]] DisflowStatus MakeStatus(const Estimate& estimate,
                                       const SendContext& context) noexcept;
[[nodiscard]] Heartbeat MakeHeartbeat(TrackingState state) noexcept;

/// @param boot_ns Now, on a clock that never runs backwards.
/// @param epoch_ns Now, since 1970; a clock that was never set, before 2015, is sent as not known.
[[nodiscard]] SystemTime MakeSystemTime(std::int64_t boot_ns, std::int64_t epoch_ns) noexcept;

/// Writes the messages of one tracked object, numbering its frames. Use one encoder per object and
/// link, so that a gap in the numbers is a lost message.
class TelemetryEncoder {
 public:
  /// @param options Valid, see Validate().
  explicit TelemetryEncoder(const TelemetryOptions& options = {}) noexcept : options_(options) {}

  /// @param out At least kFrameSize of the message (kMaxFrameSize is enough for any).
  /// @return Bytes written, or kCapacityExceeded if `out` is too small.
  [[nodiscard]] Expected<std::size_t> EncodeOdometry(const Estimate& estimate,
                                                     std::span<std::byte> out) noexcept {
    return EncodeMessage(MakeOdometry(estimate, options_.pose_frame), out);
  }
  [[nodiscard]] Expected<std::size_t> EncodeStatus(const Estimate& estimate,
                                                   const SendContext& context,
                                                   std::span<std::byte> out) noexcept {
    return EncodeMessage(MakeStatus(estimate, context), out);
  }
  /// Send once per second, so that receivers notice a silent tracker.
  [[nodiscard]] Expected<std::size_t> EncodeHeartbeat(TrackingState state,
                                                      std::span<std::byte> out) noexcept {
    return EncodeMessage(MakeHeartbeat(state), out);
  }

  /// Any other message in the name of this object.
  template <KnownMessage Message>
  [[nodiscard]] Expected<std::size_t> EncodeMessage(const Message& message,
                                                    std::span<std::byte> out) noexcept {
    const FrameHeader header{
        .sequence = sequence_,
        .system_id = options_.system_id,
        .component_id = static_cast<std::uint8_t>(kFirstComponentId + options_.object_index)};
    const Expected<std::size_t> size = EncodeFrame(message, header, out);
    if (size.ok()) ++sequence_;
    return size;
  }

 private:
  TelemetryOptions options_;
  std::uint8_t sequence_ = 0;
};

}  // namespace disflow::hal::mavlink
