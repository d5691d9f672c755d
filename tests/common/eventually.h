// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <thread>

namespace disflow::test {

/// How long a test waits for what must come. Only a test that fails ever waits so long, so a busy
/// machine has its time.
inline constexpr std::chrono::seconds kPatience{60};
inline constexpr int kPatience_ms = 60'000;

/// Asks until the answer is yes; what another thread or program does has its own time.
/// @return false if it never was.
template <class Condition>
[[nodiscard]] bool Eventually(Condition&& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace disflow::test
