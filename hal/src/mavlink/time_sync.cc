// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/time_sync.h"

#include <algorithm>
#include <limits>

#include "disflow/saturating.h"
#include "disflow/types.h"

namespace disflow::hal::mavlink {
namespace {

/// Clocks beyond it are none, and differences between clocks below it are always numbers.
constexpr std::int64_t kMaxClock_ns = std::numeric_limits<std::int64_t>::max() / 4;

}  // namespace

bool TimeSync::Ask(std::int64_t now_ns, TimeSyncMessage& question) noexcept {
  if (asked_ && now_ns - asked_at_ns_ < kInterval_ns) return false;
  asked_ = true;
  waits_ = true;
  asked_at_ns_ = now_ns;
  question = {};
  question.ts1 = now_ns;
  return true;
}

void TimeSync::Take(const FrameView& frame, std::int64_t arrived_ns) noexcept {
  TimeSyncMessage answer;
  if (DecodePayload(frame, answer) != Status::kOk || !waits_) return;
  if (answer.ts1 != asked_at_ns_ || answer.tc1 <= 0 || answer.tc1 > kMaxClock_ns) return;
  if (frame.header.component_id != kAutopilotComponent) return;
  const std::int64_t round_trip_ns = arrived_ns - asked_at_ns_;
  if (round_trip_ns < 0 || round_trip_ns > kMaxRoundTrip_ns) return;
  if (IsFromAnother(frame.header, arrived_ns)) return;
  waits_ = false;
  Add({.offset_ns = answer.tc1 - (asked_at_ns_ + round_trip_ns / 2),
       .half_round_trip_ns = round_trip_ns / 2 + 1,
       .at_ns = arrived_ns});
}

bool TimeSync::IsFromAnother(const FrameHeader& sender, std::int64_t now_ns) noexcept {
  if (system_id_ == sender.system_id) return false;
  if (system_id_ != 0 && OffsetAt(now_ns).ok()) return true;
  system_id_ = sender.system_id;
  samples_.clear();
  next_ = 0;
  rivals_ = 0;
  return false;
}

ClockOffset TimeSync::At(const Sample& sample, std::int64_t now_ns) noexcept {
  const std::int64_t age_ns = std::max<std::int64_t>(now_ns - sample.at_ns, 0);
  return {sample.offset_ns, sample.half_round_trip_ns + age_ns / kSecond_ns * kDrift_nsps +
                                age_ns % kSecond_ns * kDrift_nsps / kSecond_ns};
}

bool TimeSync::Agree(const ClockOffset& one, const ClockOffset& other) noexcept {
  const std::int64_t apart_ns = one.offset_ns > other.offset_ns ? one.offset_ns - other.offset_ns
                                                                : other.offset_ns - one.offset_ns;
  return apart_ns <= one.uncertainty_ns + other.uncertainty_ns;
}

void TimeSync::Add(const Sample& sample) noexcept {
  const ClockOffset now = At(sample, sample.at_ns);
  const Expected<ClockOffset> known = OffsetAt(sample.at_ns);
  if (!known.ok() || Agree(known.value, now)) {
    rivals_ = 0;
    return Keep(sample);
  }
  const bool goes_on = rivals_ > 0 && Agree(At(rival_, sample.at_ns), now);
  rival_ = sample;
  rivals_ = goes_on ? rivals_ + 1 : 1;
  if (rivals_ < kAgreeing) return;
  samples_.clear();
  next_ = 0;
  rivals_ = 0;
  AddSaturating(restarts_);
  Keep(sample);
}

void TimeSync::Keep(const Sample& sample) noexcept {
  if (samples_.push_back(sample)) return;
  samples_[next_] = sample;
  next_ = (next_ + 1) % kKept;
}

Expected<ClockOffset> TimeSync::OffsetAt(std::int64_t now_ns) const noexcept {
  ClockOffset best;
  bool known = false;
  std::int64_t silence_ns = kMaxSilence_ns;
  for (const Sample& sample : samples_) {
    const ClockOffset offset = At(sample, now_ns);
    if (now_ns - sample.at_ns < silence_ns) silence_ns = now_ns - sample.at_ns;
    if (known && offset.uncertainty_ns >= best.uncertainty_ns) continue;
    best = offset;
    known = true;
  }
  if (!known || silence_ns >= kMaxSilence_ns) return {{}, Status::kNotInitialised};
  return {best};
}

bool IsTimeQuestion(const FrameView& frame, TimeSyncMessage& question,
                    std::uint8_t system_id) noexcept {
  if (DecodePayload(frame, question) != Status::kOk || question.tc1 != 0) return false;
  return question.target_system == 0 || question.target_system == system_id;
}

TimeSyncMessage AnswerTo(const TimeSyncMessage& question, const FrameHeader& asker,
                         std::int64_t own_ns) noexcept {
  TimeSyncMessage answer;
  answer.tc1 = own_ns;
  answer.ts1 = question.ts1;
  answer.target_system = asker.system_id;
  answer.target_component = asker.component_id;
  return answer;
}

}  // namespace disflow::hal::mavlink
