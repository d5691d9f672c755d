// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/hal/clock.h"

namespace disflow::posix {

/// CLOCK_MONOTONIC, the clock of V4L2's capture stamps.
class MonotonicClock final : public hal::Clock {
 private:
  [[nodiscard]] std::int64_t DoNowNs() noexcept override;
  void DoSleepUntilNs(std::int64_t deadline_ns) noexcept override;
};

}  // namespace disflow::posix
