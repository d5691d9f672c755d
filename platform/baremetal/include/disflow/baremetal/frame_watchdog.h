// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/hal/clock.h"

namespace disflow::baremetal {

/// Restarts the controller if the work on a frame takes too long. Uses SysTick, which every
/// Cortex-M has, and only between Start() and Stop().
class FrameWatchdog {
 public:
  explicit FrameWatchdog(hal::Clock& clock) noexcept : clock_(clock) {}
  /// @param budget_us 0 = do not watch.
  void Start(std::uint32_t budget_us) noexcept;
  void Stop() noexcept;

 private:
  hal::Clock& clock_;
};

}  // namespace disflow::baremetal
