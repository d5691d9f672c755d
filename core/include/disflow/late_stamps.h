// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/types.h"

namespace disflow {

/// Tells frames that come late from those of a clock that was set back for good.
class LateStamps {
 public:
  /// A frame was in time.
  void Forget() noexcept { frames_ = 0; }

  /// A frame is not newer than the last one that was taken.
  /// @return Whether such frames have gone on for so long that time goes on from theirs.
  [[nodiscard]] bool GoOn(StampNs stamp_ns) noexcept {
    if (frames_ == 0 || stamp_ns <= latest_ns_) {
      frames_ = 0;
      first_ns_ = stamp_ns;
    }
    latest_ns_ = stamp_ns;
    if (frames_ < kFewest) ++frames_;
    return frames_ == kFewest && SpanNs(first_ns_, stamp_ns) > kPatience_ns;
  }

 private:
  /// A clock that is put right again costs the frames between: an object is found again within 2 s.
  static constexpr StampNs kPatience_ns = 2'000'000'000;
  /// Single wrong stamps are no clock.
  static constexpr std::uint8_t kFewest = 10;

  StampNs first_ns_ = 0;
  StampNs latest_ns_ = 0;
  std::uint8_t frames_ = 0;
};

}  // namespace disflow
