// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "disflow/baremetal/frame_watchdog.h"
#include "disflow/hal/byte_link.h"
#include "disflow/hal/clock.h"
#include "disflow/hal/depth_sensor.h"
#include "disflow/hal/depth_stream/packet.h"
#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/tracker.h"
#include "profile.h"

namespace disflow::firmware {

/// Frame in, telemetry out, for ever. Owns all of its memory.
class Firmware {
 public:
  Firmware(hal::DepthSensor& source, hal::ByteLink& telemetry, hal::Clock& clock,
           const hal::depth_stream::TimeBudgets& budgets) noexcept;

  /// Waits up to a second for a frame, tracks it and sends the estimate.
  void Step() noexcept;

 private:
  void Track(const DepthFrame& frame) noexcept;
  void SendEstimate(const Estimate& estimate) noexcept;
  void SendTiming(const Estimate& estimate, std::int64_t frame_ns) noexcept;
  void SendHeartbeatIfDue() noexcept;
  void Send(Expected<std::size_t> encoded) noexcept;

  hal::DepthSensor& source_;
  hal::ByteLink& telemetry_;
  hal::Clock& clock_;
  const hal::depth_stream::TimeBudgets& budgets_;
  baremetal::FrameWatchdog watchdog_;
  Tracker<Profile> tracker_;
  hal::mavlink::TelemetryEncoder encoder_;
  std::array<std::byte, hal::mavlink::kMaxFrameSize> message_{};
  TrackingState state_ = TrackingState::kInitialising;
  std::int64_t next_heartbeat_ns_ = 0;
  std::uint32_t stages_late_ = 0;
};

}  // namespace disflow::firmware
