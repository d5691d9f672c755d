// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_feed.h"

#include <utility>

#include "disflow/saturating.h"

namespace disflow::apps {
namespace {

constexpr std::int64_t kPatience_ns = 200'000'000;

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

FrameFeed::Turn FrameFeed::Next(DepthFrame& frame) {
  if (handover_) return TakeNewest(frame);
  Turn turn;
  turn.event = source_.Next(frame);
  turn.counters = sensor_.counters();
  turn.fault = source_.fault_status();
  return turn;
}

FrameFeed::Turn FrameFeed::TakeNewest(DepthFrame& frame) {
  Turn turn;
  switch (handover_->Take(kPatience_ns, frame, turn.fault)) {
    case FrameHandover::Taken::kFrame:
      turn.event = FrameSource::Event::kFrame;
      break;
    case FrameHandover::Taken::kFault:
      turn.event = FrameSource::Event::kUnreadable;
      break;
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
