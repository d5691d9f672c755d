// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/status.h"
#include "disflow/types.h"

namespace disflow::hal {

/// The distance of a sender's clock from the own one, learnt from when its messages arrive: the
/// quickest ones are taken for immediate.
///
/// One message alone never moves it: what is quicker counts once a second message was about as
/// quick. Messages that do not fit the distance are held against it as a rival; if for a while all
/// of them agree with the rival and none fits, the sender's clock has been set, or the sender has
/// been started anew, and the rival's distance is taken.
class SenderClock {
 public:
  /// Messages are late by less than this, or a change of the clock so small stays unnoticed.
  static constexpr std::int64_t kTolerance_ns = 50'000'000;
  /// A message that is later than this says nothing of use any more.
  static constexpr std::int64_t kMaxLate_ns = 250'000'000;
  /// How long messages have to agree that the sender's clock is another one.
  static constexpr std::int64_t kRelearn_ns = 300'000'000;

  /// @param sender_ns Stamp of a message that came in now. It and `now_ns` are in the range in
  /// which their difference is a number: a third of the type's.
  /// @return The stamp on the own clock, never later than now; kStampNotIncreasing: the stamp lies
  /// in the future, or too far back.
  [[nodiscard]] Expected<StampNs> ToOwn(std::int64_t sender_ns, std::int64_t now_ns) noexcept;

 private:
  /// Own minus sender's clock, as the messages say.
  struct Rival {
    std::int64_t offset_ns = 0;
    std::int64_t since_ns = 0;
    int messages = 0;
    bool missed = false;  ///< The last message agreed with neither.
  };

  void Age(std::int64_t now_ns) noexcept;
  void TakeQuicker(std::int64_t offset_ns, std::int64_t now_ns) noexcept;
  [[nodiscard]] bool RivalWins(std::int64_t offset_ns, std::int64_t now_ns) noexcept;

  bool known_ = false;
  std::int64_t offset_ns_ = 0;
  std::int64_t aged_at_ns_ = 0;
  bool has_quicker_ = false;
  std::int64_t quicker_offset_ns_ = 0;  ///< Not borne out yet.
  std::int64_t quicker_at_ns_ = 0;
  Rival rival_;
};

}  // namespace disflow::hal
