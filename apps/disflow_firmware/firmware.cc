// SPDX-License-Identifier: BSD-3-Clause
#include "firmware.h"

#include <algorithm>
#include <span>

#include "disflow/baremetal/startup.h"
#include "disflow/hal/mavlink/messages.h"
#include "disflow/saturating.h"
#include "disflow/types.h"

namespace disflow::firmware {
namespace {

std::int64_t Now(void* clock) noexcept { return static_cast<hal::Clock*>(clock)->NowNs(); }

}  // namespace

Firmware::Firmware(hal::DepthSensor& source, hal::ByteLink& telemetry, hal::Clock& clock,
                   const hal::depth_stream::TimeBudgets& budgets) noexcept
    : source_(source),
      telemetry_(telemetry),
      clock_(clock),
      budgets_(budgets),
      watchdog_(clock),
      tracker_(FirmwareConfig()) {}

void Firmware::Step() noexcept {
  // Both are idempotent; after a fault of the device this tries again.
  const bool open = telemetry_.Open().ok() && source_.Open().ok();
  DepthFrame frame;
  if (open && source_.Next(kSecond_ns, frame).ok()) Track(frame);
  SendHeartbeatIfDue();
}

void Firmware::Track(const DepthFrame& frame) noexcept {
  Estimate estimate;
  watchdog_.Start(budgets_.frame_us);
  const std::int64_t begin_ns = clock_.NowNs();
  (void)tracker_.Process(frame, estimate, {Now, &clock_});  // its status is in the estimate
  const std::int64_t frame_ns = clock_.NowNs() - begin_ns;
  watchdog_.Stop();
  state_ = estimate.state;
  // Receivers see the object frame start anew after a restart, too.
  estimate.reset_counter =
      static_cast<std::uint8_t>(estimate.reset_counter + baremetal::Restarts());
  if (budgets_.stage_us != 0) {
    const std::int64_t budget_ns = std::int64_t{budgets_.stage_us} * 1000;
    for (const std::int64_t stage_ns : estimate.stage_ns) {
      if (stage_ns > budget_ns) AddSaturating(stages_late_);
    }
  }
  SendEstimate(estimate);
  SendTiming(estimate, frame_ns);
}

void Firmware::SendEstimate(const Estimate& estimate) noexcept {
  Send(encoder_.EncodeOdometry(estimate, message_));
  // Stamps are on the sender's clock, so the age of a frame is not known here.
  Send(encoder_.EncodeStatus(estimate, {.sensor = source_.counters(), .totals = tracker_.totals()},
                             message_));
}

void Firmware::SendTiming(const Estimate& estimate, std::int64_t frame_ns) noexcept {
  hal::mavlink::DisflowTiming timing;
  static_assert(hal::mavlink::DisflowTiming::kStages == kStageCount);
  timing.time_usec = hal::mavlink::MicrosecondsOf(estimate.stamp_ns);
  timing.frame_ns = static_cast<std::uint64_t>(frame_ns);
  std::copy(estimate.stage_ns.begin(), estimate.stage_ns.end(), timing.stage_ns.begin());
  timing.stages_late = stages_late_;
  timing.restarts = baremetal::Restarts();
  timing.stack_bytes = static_cast<std::uint32_t>(baremetal::StackHighWater());
  Send(encoder_.EncodeMessage(timing, message_));
}

void Firmware::SendHeartbeatIfDue() noexcept {
  const std::int64_t now_ns = clock_.NowNs();
  if (now_ns < next_heartbeat_ns_) return;
  next_heartbeat_ns_ = now_ns + kSecond_ns;
  Send(encoder_.EncodeHeartbeat(state_, message_));
}

/// A message that the line cannot take is dropped whole and counted by the line.
void Firmware::Send(Expected<std::size_t> encoded) noexcept {
  if (encoded.ok()) {
    (void)telemetry_.Send(std::span<const std::byte>(message_).first(encoded.value));
  }
}

}  // namespace disflow::firmware
