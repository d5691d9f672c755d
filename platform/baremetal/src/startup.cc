// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/baremetal/startup.h"

#include "disflow/baremetal/board.h"
#include "disflow/baremetal/registers.h"

// Named by the linker script, linker/sections.ld.
extern "C" {
extern std::uint32_t disflow_stack_top[];
extern std::uint32_t disflow_stack_bottom[];
extern std::uint32_t disflow_data_load[];
extern std::uint32_t disflow_data_begin[];
extern std::uint32_t disflow_data_end[];
extern std::uint32_t disflow_bss_begin[];
extern std::uint32_t disflow_bss_end[];
extern const disflow::baremetal::Vector disflow_init_begin[];
extern const disflow::baremetal::Vector disflow_init_end[];
/// Survives a reset.
extern std::uint32_t disflow_restart_record[2];

int main();
[[noreturn]] void DisflowReset();
void DisflowSysTick();
}

namespace disflow::baremetal {
namespace {

constexpr std::uint32_t kPaint = 0xD15F10D1;
constexpr std::uint32_t kRecordMagic = 0x52455354;

[[noreturn]] void OnFault() { Restart(); }

void Unexpected() { Restart(); }

void CountStart() noexcept {
  if (disflow_restart_record[0] != kRecordMagic) {
    disflow_restart_record[0] = kRecordMagic;
    disflow_restart_record[1] = 0;
  }
}

}  // namespace

void EnableInterrupt(unsigned number) noexcept {
  constexpr std::uintptr_t kNvicEnable = 0xE000E100;
  Register(kNvicEnable + 4 * (number / 32)) = 1U << (number % 32);
}

void Restart() noexcept {
  constexpr std::uintptr_t kAircr = 0xE000ED0C;
  constexpr std::uint32_t kKeyAndReset = 0x05FA0004;
  disflow_restart_record[1] = disflow_restart_record[1] + 1;
  asm volatile("dsb" ::: "memory");
  Register(kAircr) = kKeyAndReset;
  for (;;) {
  }
}

std::uint32_t Restarts() noexcept { return disflow_restart_record[1]; }

std::size_t StackSize() noexcept {
  return sizeof(std::uint32_t) * static_cast<std::size_t>(disflow_stack_top - disflow_stack_bottom);
}

std::size_t StackHighWater() noexcept {
  const std::uint32_t* lowest = disflow_stack_bottom;
  while (lowest < disflow_stack_top && *lowest == kPaint) ++lowest;
  return sizeof(std::uint32_t) * static_cast<std::size_t>(disflow_stack_top - lowest);
}

}  // namespace disflow::baremetal

extern "C" {

[[gnu::section(".vectors"), gnu::used]] const disflow::baremetal::Vector disflow_vectors[16] = {
    reinterpret_cast<disflow::baremetal::Vector>(disflow_stack_top),
    DisflowReset,
    disflow::baremetal::OnFault,  // NMI
    disflow::baremetal::OnFault,  // HardFault
    disflow::baremetal::OnFault,  // MemManage
    disflow::baremetal::OnFault,  // BusFault
    disflow::baremetal::OnFault,  // UsageFault
    disflow::baremetal::OnFault,  // SecureFault
    nullptr,
    nullptr,
    nullptr,
    disflow::baremetal::Unexpected,  // SVCall
    disflow::baremetal::Unexpected,  // DebugMonitor
    nullptr,
    disflow::baremetal::Unexpected,  // PendSV
    DisflowSysTick,
};

/// Nothing is initialised yet and the stack is empty.
[[noreturn]] void DisflowReset() {
  using namespace disflow::baremetal;
  constexpr std::uintptr_t kCpacr = 0xE000ED88;
  constexpr std::uint32_t kFpuFullAccess = 0xFU << 20U;
  Register(kCpacr) = Register(kCpacr) | kFpuFullAccess;
  asm volatile("dsb\n isb" ::: "memory");
  volatile std::uint32_t* in_use;
  asm volatile("mov %0, sp" : "=r"(in_use));
  for (volatile std::uint32_t* word = disflow_stack_bottom; word < in_use; ++word) *word = kPaint;
  const std::uint32_t* from = disflow_data_load;
  for (std::uint32_t* to = disflow_data_begin; to < disflow_data_end;) *to++ = *from++;
  for (std::uint32_t* to = disflow_bss_begin; to < disflow_bss_end;) *to++ = 0;
  CountStart();
  for (const Vector* init = disflow_init_begin; init < disflow_init_end; ++init) (*init)();
  StartBoard();
  (void)main();
  Restart();
}

/// Boards without a watchdog in their image do not need SysTick.
[[gnu::weak]] void DisflowSysTick() {}

}  // extern "C"
