// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>

namespace disflow::test {

/// Where recordings of real cameras lie: the environment's DISFLOW_TEST_DATA, else what CMake was
/// told.
[[nodiscard]] inline std::filesystem::path TestData(const char* name) {
  const char* const folder = std::getenv("DISFLOW_TEST_DATA");
  return std::filesystem::path(folder != nullptr ? folder : DISFLOW_TEST_DATA) / name;
}

}  // namespace disflow::test

/// Leaves the test with a reason if a recording is not there.
#define DISFLOW_SKIP_WITHOUT(folder)                                                 \
  if (!std::filesystem::exists(folder))                                              \
  GTEST_SKIP() << "recordings of real cameras; set DISFLOW_TEST_DATA to the folder " \
               << "that holds them (" << (folder) << " is not there)"
