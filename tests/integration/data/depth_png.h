// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace disflow::test {

/// A 16-bit depth image.
struct DepthPng {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> pixels;
};

/// @throws std::runtime_error naming the file.
[[nodiscard]] DepthPng ReadDepthPng(const std::filesystem::path& file);

}  // namespace disflow::test
