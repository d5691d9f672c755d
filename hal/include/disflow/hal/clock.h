// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace disflow::hal {

/// Monotonic time. The only source of time in a program; core is given stamps and never reads a
/// clock.
class Clock {
 public:
  Clock(const Clock&) = delete;
  Clock& operator=(const Clock&) = delete;

  /// Nanoseconds since an arbitrary start; never runs backwards.
  [[nodiscard]] std::int64_t NowNs() noexcept { return DoNowNs(); }
  /// Returns at `deadline_ns` or as soon as possible after it.
  void SleepUntilNs(std::int64_t deadline_ns) noexcept { DoSleepUntilNs(deadline_ns); }

 protected:
  Clock() = default;
  ~Clock() = default;  // see DepthSensor

 private:
  [[nodiscard]] virtual std::int64_t DoNowNs() noexcept = 0;
  virtual void DoSleepUntilNs(std::int64_t deadline_ns) noexcept = 0;
};

}  // namespace disflow::hal
