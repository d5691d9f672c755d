// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "limited_process.h"

namespace disflow::test {

inline constexpr const char* kHostileDepth = "/depth";
inline constexpr const char* kHostileInfo = "/info";
inline constexpr const char* kHostileMask = "/mask";

/// A recording of ROS that was made to do harm, or to look like it.
struct HostileBag {
  const char* test;  ///< Name of the test.
  const char* name;
  std::string (*contents)();
  /// Part of what is said against it; empty if all of it is played.
  const char* fault = "";
  std::int64_t length = -1;  ///< Longer than the contents: a hole follows; it takes no room.
  bool with_masks = false;
  unsigned most_s = kMostTime_s;
};

[[nodiscard]] const std::vector<HostileBag>& HostileBags();

}  // namespace disflow::test
