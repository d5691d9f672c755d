// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_source.h"

#include <algorithm>
#include <limits>

#include "disflow/types.h"
#include "program/exit_status.h"
#include "program/stop_signal.h"

namespace disflow::apps {
namespace {

/// Also how soon a stop signal is noticed.
constexpr std::int64_t kTimeout_ns = kSecond_ns / 5;
constexpr std::int64_t kSaidUnreadable = 5;
constexpr std::uint32_t kSaidRestarts = 5;

}  // namespace

FrameSource::FrameSource(hal::DepthSensor& sensor, hal::Clock& clock, Rate rate,
                         std::int64_t max_frames, Console& console) noexcept
    : sensor_(sensor),
      clock_(clock),
      live_(sensor.info().live),
      monotonic_(sensor.info().has_monotonic_stamps()),
      paced_(rate != Rate::kMax && !live_),
      max_frames_(max_frames > 0 ? max_frames : std::numeric_limits<std::int64_t>::max()),
      console_(console) {}

FrameSource::Event FrameSource::Next(DepthFrame& frame) {
  if (StopRequested() || taken_ >= max_frames_) return Event::kEnd;
  const hal::Fault fault = sensor_.Next(kTimeout_ns, frame);
  switch (fault.status) {
    case Status::kOk:
      if (lost_) console_.Say("the sensor is back");
      lost_ = false;
      ++taken_;
      Pace(frame.stamp_ns);
      return Event::kFrame;
    case Status::kEndOfStream:
      return Event::kEnd;
    case Status::kTimeout:
      SayRestart(fault);
      return Event::kIdle;
    case Status::kTruncated:
    case Status::kCorrupt:
      ++taken_;
      SayUnreadable(fault);
      return Event::kUnreadable;
    case Status::kDeviceLost:
      if (!live_) break;
      TryReopen(fault);
      return Event::kIdle;
    default:
      break;
  }
  throw Failure(kInputFailed, fault.message);
}

std::int64_t FrameSource::AgeNs(StampNs stamp_ns) noexcept {
  return monotonic_ ? clock_.NowNs() - stamp_ns : -1;
}

void FrameSource::Pace(StampNs stamp_ns) noexcept {
  if (!paced_) return;
  const std::int64_t due_ns = pacer_.DueNs(stamp_ns, clock_.NowNs());
  while (!StopRequested()) {
    const std::int64_t now_ns = clock_.NowNs();
    if (now_ns >= due_ns) return;
    clock_.SleepUntilNs(std::min(due_ns, now_ns + kTimeout_ns));
  }
}

void FrameSource::SayUnreadable(const hal::Fault& fault) noexcept {
  fault_status_ = fault.status;
  ++unreadable_;
  if (unreadable_ <= kSaidUnreadable) console_.Say(fault.message, Severity::kWarning);
  if (unreadable_ == kSaidUnreadable) console_.Say("further unreadable frames are only counted");
}

void FrameSource::SayRestart(const hal::Fault& fault) noexcept {
  const std::uint32_t restarts = sensor_.counters().restarts;
  if (restarts == restarts_) return;
  restarts_ = restarts;
  if (restarts_ <= kSaidRestarts) console_.Say(fault.message, Severity::kWarning);
  if (restarts_ == kSaidRestarts) console_.Say("further starts of the stream are only counted");
}

void FrameSource::TryReopen(const hal::Fault& fault) noexcept {
  if (!lost_) {
    console_.Say(std::string(fault.message) + "; waiting for it to come back", Severity::kWarning);
    open_status_ = Status::kNotFound;
  }
  lost_ = true;
  clock_.SleepUntilNs(clock_.NowNs() + kTimeout_ns);
  const hal::Fault opened = sensor_.Open();
  // Not there yet is known; what else is wrong is said once.
  if (!opened.ok() && opened.status != open_status_)
    console_.Say(opened.message, Severity::kWarning);
  open_status_ = opened.status;
}

}  // namespace disflow::apps
