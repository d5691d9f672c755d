// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_feed.h"

#include <algorithm>
#include <utility>

#include "disflow/saturating.h"

namespace disflow::apps {
namespace {

constexpr std::int64_t kPatience_ns = 200'000'000;
/// After a turn for other input, so that much of it costs no more than 2000 turns per second. Short
/// against the millisecond to which clocks are compared.
constexpr std::int64_t kInputRest_ns = 500'000;

}  // namespace

FrameFeed::FrameFeed(hal::DepthSensor& sensor, FrameSource& source, bool threaded,
                     const RealtimeOptions& realtime, Console& console)
    : sensor_(sensor), source_(source) {
  if (!threaded) return;
  const hal::SensorInfo info = sensor.info();
  handover_ = std::make_unique<FrameHandover>(info.width_px, info.height_px, !info.live);
  thread_ = std::thread([this, &realtime, &console] { Capture(realtime, console); });
}

FrameFeed::~FrameFeed() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

FrameFeed::Turn FrameFeed::Next(DepthFrame& frame, std::span<const int> inputs) {
  if (handover_) return TakeNewest(frame, inputs);
  Turn turn;
  turn.event = source_.Next(frame);
  turn.counters = sensor_.counters();
  turn.fault = source_.fault_status();
  return turn;
}

FrameHandover::Taken FrameFeed::AwaitNewest(DepthFrame& frame, Status& fault,
                                            std::span<const int> inputs) {
  std::int64_t now_ns = clock_.NowNs();
  if (idle_at_ns_ == 0) idle_at_ns_ = now_ns + kPatience_ns;
  const auto await = [&](std::int64_t until_ns, std::span<const int> also) {
    return handover_->Take(std::max<std::int64_t>(until_ns - now_ns, 0), frame, fault, also);
  };
  const std::int64_t rested_ns = std::min(input_at_ns_ + kInputRest_ns, idle_at_ns_);
  FrameHandover::Taken taken = FrameHandover::Taken::kNothing;
  if (now_ns < rested_ns) taken = await(rested_ns, {});
  if (taken == FrameHandover::Taken::kNothing) {
    now_ns = clock_.NowNs();
    taken = await(idle_at_ns_, inputs);
  }
  if (taken == FrameHandover::Taken::kInput) {
    input_at_ns_ = clock_.NowNs();
  } else {
    idle_at_ns_ = 0;
  }
  return taken;
}

FrameFeed::Turn FrameFeed::TakeNewest(DepthFrame& frame, std::span<const int> inputs) {
  Turn turn;
  switch (AwaitNewest(frame, turn.fault, inputs)) {
    case FrameHandover::Taken::kFrame:
      turn.event = FrameSource::Event::kFrame;
      break;
    case FrameHandover::Taken::kFault:
      turn.event = FrameSource::Event::kUnreadable;
      break;
    case FrameHandover::Taken::kInput:
      turn.event = FrameSource::Event::kInput;
      return turn;
    case FrameHandover::Taken::kNothing:
      turn.event = FrameSource::Event::kIdle;
      break;
    case FrameHandover::Taken::kEnd:
      turn.event = FrameSource::Event::kEnd;
      break;
  }
  const std::uint32_t turns = capture_turns_;
  turn.source_is_alive = turns != std::exchange(seen_turns_, turns);
  {
    const std::lock_guard lock(counters_mutex_);
    turn.counters = counters_;
  }
  const std::uint32_t replaced = handover_->dropped();
  AddSaturating(turn.counters.dropped, replaced);
  AddSaturating(turn.counters.skipped, replaced);
  return turn;
}

void FrameFeed::Capture(const RealtimeOptions& realtime, Console& console) {
  ApplyToCaptureThread(realtime, console);
  try {
    CaptureAll();
    handover_->End(nullptr);
  } catch (...) {
    handover_->End(std::current_exception());
  }
}

void FrameFeed::CaptureAll() {
  DepthFrame frame;
  while (!stop_) {
    const FrameSource::Event event = source_.Next(frame);
    {
      const std::lock_guard lock(counters_mutex_);
      counters_ = sensor_.counters();
    }
    ++capture_turns_;
    if (event == FrameSource::Event::kEnd) return;
    if (event == FrameSource::Event::kFrame) handover_->Put(frame);
    if (event == FrameSource::Event::kUnreadable) handover_->PutFault(source_.fault_status());
  }
}

}  // namespace disflow::apps
