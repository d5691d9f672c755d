// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

/// @file
/// Output and exit through a debugger or an emulator (Arm's semihosting). Without one the processor
/// stops at the breakpoint, so this is for tests only.

namespace disflow::firmware_test {

inline std::uint32_t Semihost(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

inline void Print(const char* text) {
  constexpr std::uint32_t kWrite0 = 0x04;
  (void)Semihost(kWrite0, text);
}

[[noreturn]] inline void Exit(std::uint32_t status) {
  constexpr std::uint32_t kExitExtended = 0x20;
  constexpr std::uint32_t kApplicationExit = 0x20026;
  const std::uint32_t arguments[2] = {kApplicationExit, status};
  for (;;) (void)Semihost(kExitExtended, arguments);
}

}  // namespace disflow::firmware_test
