// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/baremetal/frame_watchdog.h"

#include "disflow/baremetal/registers.h"
#include "disflow/baremetal/startup.h"

extern "C" void DisflowSysTick();

namespace disflow::baremetal {
namespace {

constexpr std::uintptr_t kSysTickControl = 0xE000E010;
constexpr std::uintptr_t kSysTickReload = 0xE000E014;
constexpr std::uintptr_t kSysTickValue = 0xE000E018;
constexpr std::uint32_t kOnWithInterrupt = 7;  // processor clock
/// Cycles between two looks at the clock: 2 ms at 480 MHz.
constexpr std::uint32_t kPeriod = 1U << 20U;

hal::Clock* watched_clock = nullptr;
volatile std::int64_t deadline_ns = 0;

}  // namespace

void FrameWatchdog::Start(std::uint32_t budget_us) noexcept {
  if (budget_us == 0) return;
  watched_clock = &clock_;
  deadline_ns = clock_.NowNs() + std::int64_t{budget_us} * 1000;
  Register(kSysTickReload) = kPeriod - 1;
  Register(kSysTickValue) = 0;
  Register(kSysTickControl) = kOnWithInterrupt;
}

void FrameWatchdog::Stop() noexcept { Register(kSysTickControl) = 0; }

}  // namespace disflow::baremetal

extern "C" void DisflowSysTick() {
  using namespace disflow::baremetal;
  if (watched_clock != nullptr && watched_clock->NowNs() > deadline_ns) Restart();
}
