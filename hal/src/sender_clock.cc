// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/sender_clock.h"

#include <algorithm>

namespace disflow::hal {
namespace {

/// Two quartzes run apart by less than this share; so much the learnt offset may grow back.
constexpr std::int64_t kClockDrift = 10'000;
/// How long a message that was quicker than all others waits for one that bears it out.
constexpr std::int64_t kQuickerWaits_ns = 10'000'000'000;
constexpr int kRivalMessages = 3;

constexpr bool IsWithin(std::int64_t difference_ns, std::int64_t limit_ns) noexcept {
  return difference_ns <= limit_ns && difference_ns >= -limit_ns;
}

}  // namespace

Expected<StampNs> SenderClock::ToOwn(std::int64_t sender_ns, std::int64_t now_ns) noexcept {
  const std::int64_t offset_ns = now_ns - sender_ns;
  if (!known_) {
    known_ = true;
    offset_ns_ = offset_ns;
    aged_at_ns_ = now_ns;
  }
  Age(now_ns);
  const bool fits = IsWithin(offset_ns - offset_ns_, kTolerance_ns);
  if (fits) {
    rival_ = {};
    if (offset_ns < offset_ns_) TakeQuicker(offset_ns, now_ns);
  } else if (RivalWins(offset_ns, now_ns)) {
    offset_ns_ = rival_.offset_ns;
    rival_ = {};
    has_quicker_ = false;
  }
  const std::int64_t late_ns = offset_ns - offset_ns_;
  if (late_ns < -kTolerance_ns || late_ns > kMaxLate_ns) return {0, Status::kStampNotIncreasing};
  return {sender_ns + std::min(offset_ns_, offset_ns)};
}

void SenderClock::Age(std::int64_t now_ns) noexcept {
  offset_ns_ += std::max<std::int64_t>(now_ns - aged_at_ns_, 0) / kClockDrift;
  aged_at_ns_ = now_ns;
}

void SenderClock::TakeQuicker(std::int64_t offset_ns, std::int64_t now_ns) noexcept {
  const bool waits = has_quicker_ && now_ns - quicker_at_ns_ <= kQuickerWaits_ns;
  if (waits) offset_ns_ = std::max(offset_ns, quicker_offset_ns_);
  if (!waits || offset_ns < quicker_offset_ns_) {
    quicker_offset_ns_ = offset_ns;
    quicker_at_ns_ = now_ns;
  }
  has_quicker_ = true;
}

bool SenderClock::RivalWins(std::int64_t offset_ns, std::int64_t now_ns) noexcept {
  const bool agrees = rival_.messages > 0 && IsWithin(offset_ns - rival_.offset_ns, kMaxLate_ns);
  if (!agrees) {
    // A wrong stamp in the midst of a rival must not cost it what it has shown; two would.
    if (rival_.messages > 1 && !rival_.missed) {
      rival_.missed = true;
      return false;
    }
    rival_ = {.offset_ns = offset_ns, .since_ns = now_ns};
  }
  rival_.missed = false;
  rival_.offset_ns = std::min(rival_.offset_ns, offset_ns);
  ++rival_.messages;
  return rival_.messages >= kRivalMessages && now_ns - rival_.since_ns >= kRelearn_ns;
}

}  // namespace disflow::hal
