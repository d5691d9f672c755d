// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/types.h"

namespace disflow::apps {

/// Plays a recording at the pace of its capture stamps: says when each frame is due. Stamps come
/// from files, so any value may occur; the time from one frame to the next is bounded by
/// kLongestGap_ns.
class StampPacer {
 public:
  /// A longer step forwards, like any step backwards, is a jump in the recording and no pause of
  /// the camera: the frame is due at once, and the clock of the recording goes on from there.
  static constexpr std::int64_t kLongestGap_ns = 5'000'000'000;
  /// Whoever takes frames later than this is not given the following ones faster to make up for it.
  static constexpr std::int64_t kLatest_ns = 500'000'000;

  /// To be called once per frame, in their order.
  /// @param now_ns Never runs backwards.
  /// @return When the frame is due on the same clock; perhaps in the past.
  [[nodiscard]] std::int64_t DueNs(StampNs stamp_ns, std::int64_t now_ns) noexcept {
    if (!started_ || Jumps(stamp_ns)) {
      started_ = true;
      base_ns_ = now_ns;
      base_stamp_ns_ = stamp_ns;
    }
    previous_stamp_ns_ = stamp_ns;
    const std::int64_t due_ns = base_ns_ + (stamp_ns - base_stamp_ns_);
    const std::int64_t late_ns = now_ns - due_ns;
    if (late_ns > kLatest_ns) base_ns_ += late_ns;
    return due_ns;
  }

 private:
  [[nodiscard]] bool Jumps(StampNs stamp_ns) const noexcept {
    if (stamp_ns < previous_stamp_ns_) return true;
    // Unsigned, since the difference of two 64-bit stamps may not fit into another.
    const std::uint64_t step_ns =
        static_cast<std::uint64_t>(stamp_ns) - static_cast<std::uint64_t>(previous_stamp_ns_);
    return step_ns > static_cast<std::uint64_t>(kLongestGap_ns);
  }

  bool started_ = false;
  std::int64_t base_ns_ = 0;  ///< On the clock, when base_stamp_ns_ was due.
  StampNs base_stamp_ns_ = 0;
  StampNs previous_stamp_ns_ = 0;
};

}  // namespace disflow::apps
