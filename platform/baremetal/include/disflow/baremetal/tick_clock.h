// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/baremetal/startup.h"
#include "disflow/hal/clock.h"

namespace disflow::baremetal {

/// Monotonic time from a free-running 32-bit counter, such as a timer or DWT->CYCCNT. It must be
/// read at least once per wrap. May be read from interrupts.
/// @tparam ReadTicks Function that returns the counter, counting up.
/// @tparam kTicksPerSecond Its rate.
template <std::uint32_t (*ReadTicks)(), std::uint32_t kTicksPerSecond>
class TickClock final : public hal::Clock {
 private:
  [[nodiscard]] std::int64_t DoNowNs() noexcept override {
    constexpr std::uint64_t kNsPerSecond = 1'000'000'000;
    std::uint64_t total;
    {
      const InterruptLock lock;
      const std::uint32_t now = ReadTicks();
      total_ += now - last_;
      last_ = now;
      total = total_;
    }
    if constexpr (kNsPerSecond % kTicksPerSecond == 0) {
      // Without a division, whose cost depends on the time.
      return static_cast<std::int64_t>(total * (kNsPerSecond / kTicksPerSecond));
    } else {
      const std::uint64_t seconds = total / kTicksPerSecond;
      const std::uint64_t rest = total % kTicksPerSecond;
      return static_cast<std::int64_t>(seconds * kNsPerSecond +
                                       rest * kNsPerSecond / kTicksPerSecond);
    }
  }
  void DoSleepUntilNs(std::int64_t deadline_ns) noexcept override {
    while (DoNowNs() < deadline_ns) {
    }
  }

  std::uint64_t total_ = 0;
  std::uint32_t last_ = 0;
};

}  // namespace disflow::baremetal
