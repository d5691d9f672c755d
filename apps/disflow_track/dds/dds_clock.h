// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ctime>

#include "disflow/types.h"

namespace disflow::apps {

/// From capture stamps to ROS time (nanoseconds since 1970). The distance between the two clocks is
/// measured once, so that stamps keep their exact distances whatever is done to the system's clock
/// later.
class DdsClock {
 public:
  /// @param live Stamps are of CLOCK_MONOTONIC. Else the first one is taken for now: a replay looks
  /// as if it began when this was made.
  explicit DdsClock(bool live) noexcept
      : known_(live), offset_ns_(Now(CLOCK_REALTIME) - (live ? Now(CLOCK_MONOTONIC) : 0)) {}

  [[nodiscard]] std::int64_t ToRos(StampNs stamp_ns) noexcept {
    if (!known_) offset_ns_ -= stamp_ns;
    known_ = true;
    return stamp_ns + offset_ns_;
  }

  /// The way back, for stamps of others. Only if known().
  [[nodiscard]] StampNs FromRos(std::int64_t ros_ns) const noexcept { return ros_ns - offset_ns_; }
  /// @return false: no stamp has come yet that would tell.
  [[nodiscard]] bool known() const noexcept { return known_; }

 private:
  static std::int64_t Now(clockid_t clock) noexcept {
    timespec now{};
    (void)clock_gettime(clock, &now);  // cannot fail for these clocks
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  }

  bool known_;
  std::int64_t offset_ns_;  ///< Of a replay the moment of its beginning, until known_.
};

}  // namespace disflow::apps
