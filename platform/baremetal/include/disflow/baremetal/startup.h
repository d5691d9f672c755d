// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace disflow::baremetal {

/// An entry of the vector table.
using Vector = void (*)();

/// Puts a board's table of interrupt vectors, `const Vector kName[]`, behind the processor's.
#define DISFLOW_BOARD_VECTORS [[gnu::section(".vectors.board"), gnu::used]]

/// Lets an interrupt of the board through. @param number Its place in the board's table.
void EnableInterrupt(unsigned number) noexcept;

/// Resets the controller; the restart is counted.
[[noreturn]] void Restart() noexcept;
/// Restarts since power-on, by Restart() or by a processor fault.
[[nodiscard]] std::uint32_t Restarts() noexcept;

/// Most bytes that the stack has held since the reset: it is painted at the start.
[[nodiscard]] std::size_t StackHighWater() noexcept;
[[nodiscard]] std::size_t StackSize() noexcept;

/// Keeps interrupts off while it lives.
class InterruptLock {
 public:
  InterruptLock() noexcept {
    asm volatile("mrs %0, primask\n cpsid i" : "=r"(before_) : : "memory");
  }
  ~InterruptLock() { asm volatile("msr primask, %0" : : "r"(before_) : "memory"); }
  InterruptLock(const InterruptLock&) = delete;
  InterruptLock& operator=(const InterruptLock&) = delete;

 private:
  std::uint32_t before_;
};

}  // namespace disflow::baremetal
