// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace disflow::test {

/// Who reads a file.
enum class Reader : std::uint8_t {
  kPng,
  kObj,
  kFloatDepth,
  kReplay,  ///< A whole sequence, of which the file is one.
  kModel,
  kPly,
  kCsv,
  kTruth,     ///< A sequence's ground truth, of which the file is one.
  kImages,    ///< A sequence's images, as evaluated.
  kSettings,  ///< TOML.
  kCamera,    ///< TOML.
};

/// A file that was made to do harm.
struct HostileFile {
  const char* test;  ///< Name of the test.
  Reader reader;
  const char* name;  ///< In its folder.
  std::string (*contents)();
  std::int64_t length = -1;  ///< Longer than the contents: a hole follows; it takes no room.
};

[[nodiscard]] const std::vector<HostileFile>& HostileFiles();

/// Files that are good, and as large as a megabyte can make them.
[[nodiscard]] const std::vector<HostileFile>& LargeFiles();

}  // namespace disflow::test
