// SPDX-License-Identifier: BSD-3-Clause
#include "links/link_stamps.h"

#include <algorithm>
#include <ctime>

namespace disflow::apps {
namespace {

std::int64_t Read(clockid_t clock) noexcept {
  timespec now{};
  (void)::clock_gettime(clock, &now);  // cannot fail for these clocks
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace

ClockReading ReadClocks() noexcept { return {Read(CLOCK_MONOTONIC), Read(CLOCK_REALTIME)}; }

LinkStamps::Source LinkStamps::SourceOf(const hal::SensorInfo& sensor) noexcept {
  if (sensor.has_monotonic_stamps()) return Source::kMonotonic;
  return sensor.epoch_stamps ? Source::kEpoch : Source::kRecording;
}

void LinkStamps::Play(StampNs capture_ns, const ClockReading& now) noexcept {
  if (source_ != Source::kRecording) return;
  // Stamps of files may be any number.
  std::int64_t offset_ns = 0;
  std::int64_t step_ns = 0;
  if (__builtin_sub_overflow(now.monotonic_ns, capture_ns, &offset_ns)) return;
  if (__builtin_sub_overflow(capture_ns, played_ns_, &step_ns) || step_ns < -kLongestStep_ns ||
      step_ns > kLongestStep_ns) {
    played_ = false;
  }
  played_ns_ = capture_ns;
  played_offset_ns_ = played_ ? std::min(played_offset_ns_, offset_ns) : offset_ns;
  played_ = true;
}

std::optional<StampNs> LinkStamps::Of(StampNs capture_ns, const ClockReading& now,
                                      const hal::mavlink::TimeSync& other) const noexcept {
  if (wanted_ == Stamps::kCapture) return capture_ns;
  if (wanted_ == Stamps::kEpoch && source_ == Source::kEpoch) return capture_ns;
  std::int64_t offset_ns = 0;
  if (source_ == Source::kRecording) offset_ns = played_offset_ns_;
  if (source_ == Source::kEpoch) offset_ns = now.monotonic_ns - now.epoch_ns;
  std::int64_t monotonic_ns = 0;
  if (__builtin_add_overflow(capture_ns, offset_ns, &monotonic_ns)) return std::nullopt;
  return OfMonotonic(monotonic_ns, now, other);
}

std::optional<StampNs> LinkStamps::Now(const ClockReading& now,
                                       const hal::mavlink::TimeSync& other) const noexcept {
  if (wanted_ != Stamps::kCapture) return OfMonotonic(now.monotonic_ns, now, other);
  if (source_ == Source::kEpoch) return now.epoch_ns;
  if (source_ == Source::kMonotonic) return now.monotonic_ns;
  if (!played_) return std::nullopt;
  return now.monotonic_ns - played_offset_ns_;
}

std::optional<StampNs> LinkStamps::OfMonotonic(std::int64_t monotonic_ns, const ClockReading& now,
                                               const hal::mavlink::TimeSync& other) const noexcept {
  std::int64_t offset_ns = 0;
  if (wanted_ == Stamps::kEpoch) offset_ns = now.epoch_ns - now.monotonic_ns;
  if (wanted_ == Stamps::kAutopilot) {
    const auto learnt = other.OffsetAt(now.monotonic_ns);
    if (!learnt.ok()) return std::nullopt;
    offset_ns = learnt.value.offset_ns;
  }
  std::int64_t stamp_ns = 0;
  if (__builtin_add_overflow(monotonic_ns, offset_ns, &stamp_ns)) return std::nullopt;
  return stamp_ns;
}

}  // namespace disflow::apps
