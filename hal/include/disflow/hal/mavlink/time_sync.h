// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/messages.h"
#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/memory/fixed_vector.h"

/// @file
/// How far the clocks at the two ends of a link are apart, by TIMESYNC.

namespace disflow::hal::mavlink {

/// Another clock minus the own one, and by how much that may be wrong.
struct ClockOffset {
  std::int64_t offset_ns = 0;
  std::int64_t uncertainty_ns = 0;
};

/// Learns the clock of the autopilot at the other end from its answers. Each answer was made
/// between the question and its own arrival, so it bounds the offset from both sides; of the last
/// ones that with the closest bounds counts. Answers that contradict it are passed over until there
/// are kAgreeing of them that agree with each other: then the clock was set, or the autopilot
/// started anew.
class TimeSync {
 public:
  static constexpr std::int64_t kInterval_ns = 250'000'000;  ///< From question to question.
  /// An answer that took longer bounds too little; also, each has gone when the next is asked for.
  static constexpr std::int64_t kMaxRoundTrip_ns = kInterval_ns;
  /// What an offset is wrong by after a second: two crystals, each 50 ppm off.
  static constexpr std::int64_t kDrift_nsps = 100'000;
  /// Without answers for so long the offset is not known any more: 3 ms by drift alone.
  static constexpr std::int64_t kMaxSilence_ns = 30'000'000'000;
  static constexpr int kAgreeing = 3;
  static constexpr int kKept = 16;                        ///< Four seconds of answers.
  static constexpr std::uint8_t kAutopilotComponent = 1;  ///< MAV_COMP_ID_AUTOPILOT1.

  /// @param now_ns On the own clock, which never runs backwards.
  /// @param question Filled if one is due.
  /// @return Whether it is to be sent now.
  [[nodiscard]] bool Ask(std::int64_t now_ns, TimeSyncMessage& question) noexcept;

  /// Takes the answer to the last question, of the first autopilot that gave one until that is
  /// silent for kMaxSilence_ns; passes over everything else.
  /// @param arrived_ns When the frame came, on the own clock.
  void Take(const FrameView& frame, std::int64_t arrived_ns) noexcept;

  /// @return kNotInitialised while the other clock is not known.
  [[nodiscard]] Expected<ClockOffset> OffsetAt(std::int64_t now_ns) const noexcept;

  /// Times the other clock was found to be another one; saturating.
  [[nodiscard]] std::uint32_t restarts() const noexcept { return restarts_; }

 private:
  struct Sample {
    std::int64_t offset_ns = 0;
    std::int64_t half_round_trip_ns = 0;
    std::int64_t at_ns = 0;
  };

  [[nodiscard]] static ClockOffset At(const Sample& sample, std::int64_t now_ns) noexcept;
  [[nodiscard]] static bool Agree(const ClockOffset& one, const ClockOffset& other) noexcept;
  [[nodiscard]] bool IsFromAnother(const FrameHeader& sender, std::int64_t now_ns) noexcept;
  void Add(const Sample& sample) noexcept;
  void Keep(const Sample& sample) noexcept;

  bool asked_ = false;
  bool waits_ = false;  ///< The last question has not been answered.
  std::int64_t asked_at_ns_ = 0;
  std::uint8_t system_id_ = 0;  ///< Whose clock it is; 0: nobody's yet.
  FixedVector<Sample, kKept> samples_;
  int next_ = 0;  ///< The oldest of a full list.
  Sample rival_;
  int rivals_ = 0;  ///< Answers in a row that contradict, and agree with each other.
  std::uint32_t restarts_ = 0;
};

/// @return Whether the frame asks this system for its clock; `question` is filled then.
[[nodiscard]] bool IsTimeQuestion(const FrameView& frame, TimeSyncMessage& question,
                                  std::uint8_t system_id = TelemetryOptions{}.system_id) noexcept;

/// @param own_ns Now, on the clock that was asked for.
[[nodiscard]] TimeSyncMessage AnswerTo(const TimeSyncMessage& question, const FrameHeader& asker,
                                       std::int64_t own_ns) noexcept;

}  // namespace disflow::hal::mavlink
