// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

#include "scratch_folder.h"

namespace disflow::test {

/// Long enough that it never ends by itself during a test.
inline constexpr const char* kEndlessSensor = "sim:bottle?frames=30000";

/// Waits until a running program has written some lines.
inline void AwaitLines(const std::string& file, std::ptrdiff_t lines) {
  for (int i = 0; i < 3000; ++i) {
    const std::string text = ReadFile(file);
    if (std::count(text.begin(), text.end(), '\n') >= lines) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  FAIL() << file << " does not grow";
}

}  // namespace disflow::test
