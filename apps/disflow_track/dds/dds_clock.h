// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ctime>
#include <limits>

#include "disflow/types.h"

namespace disflow::apps {

/// From capture stamps to ROS time (nanoseconds since 1970). The distance between the two clocks is
/// measured once, so that stamps keep their exact distances whatever is done to the system's clock
/// later.
class DdsClock {
 public:
  /// Reads a clock of the system; clock_gettime() but for tests.
  using Read = std::int64_t (*)(clockid_t);

  /// Which clock stamps are of.
  enum class Stamps {
    kSequence,   ///< A replay's: it looks as if it began when this was made.
    kMonotonic,  ///< CLOCK_MONOTONIC.
    kRos,        ///< ROS's own, which need not be the system's: they are left as they are.
  };

  explicit DdsClock(Stamps stamps, Read read = &ReadSystem) noexcept
      : read_(read),
        stamps_(stamps),
        known_(stamps != Stamps::kSequence),
        distance_ns_(Distance()),
        offset_ns_(FirstOffset()) {}

  [[nodiscard]] std::int64_t ToRos(StampNs stamp_ns) noexcept {
    if (!known_) offset_ns_ -= stamp_ns;
    known_ = true;
    return stamp_ns + offset_ns_;
  }

  /// The way back, for stamps that were made by ToRos(). Only if known().
  [[nodiscard]] StampNs FromRos(std::int64_t ros_ns) const noexcept { return ros_ns - offset_ns_; }
  /// For stamps that others read from a clock of theirs, kept in step with the system's: follows
  /// it when it is set. Only if known().
  [[nodiscard]] StampNs FromRosOfOthers(std::int64_t ros_ns) const noexcept {
    return stamps_ == Stamps::kRos ? ros_ns : FromRos(ros_ns) - (Distance() - distance_ns_);
  }
  /// @return false: no stamp has come yet that would tell.
  [[nodiscard]] bool known() const noexcept { return known_; }

 private:
  static std::int64_t ReadSystem(clockid_t clock) noexcept {
    timespec now{};
    (void)clock_gettime(clock, &now);  // cannot fail for these clocks
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  }
  [[nodiscard]] std::int64_t FirstOffset() const noexcept {
    if (stamps_ == Stamps::kRos) return 0;
    return known_ ? distance_ns_ : read_(CLOCK_REALTIME);
  }
  [[nodiscard]] std::int64_t Distance() const noexcept {
    // Whoever is interrupted between two readings reads again.
    constexpr int kTries = 8;
    constexpr std::int64_t kAtOnce_ns = 20'000;
    std::int64_t least_ns = std::numeric_limits<std::int64_t>::max();
    std::int64_t distance_ns = 0;
    for (int i = 0; i < kTries && least_ns > kAtOnce_ns; ++i) {
      const std::int64_t before_ns = read_(CLOCK_MONOTONIC);
      const std::int64_t real_ns = read_(CLOCK_REALTIME);
      const std::int64_t took_ns = read_(CLOCK_MONOTONIC) - before_ns;
      if (took_ns >= least_ns) continue;
      least_ns = took_ns;
      distance_ns = real_ns - before_ns - took_ns / 2;
    }
    return distance_ns;
  }

  Read read_;
  Stamps stamps_;
  bool known_;
  std::int64_t distance_ns_;  ///< Of the system's two clocks, when this was made.
  std::int64_t offset_ns_;    ///< Of a replay the moment of its beginning, until known_.
};

}  // namespace disflow::apps
