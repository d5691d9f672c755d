// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// Grey image of 8 or 16 bits per pixel, row-major; values as stored in the file.
struct GreyImage {
  int width_px = 0;
  int height_px = 0;
  int bits = 0;  ///< 8 or 16, as in the file.
  std::vector<std::uint16_t> pixels;
};

/// @param image Keeps its memory from call to call. Unspecified unless the result is ok.
/// @return kNotFound, kUnsupported (not grey, not PNG), kTruncated or kCorrupt, with the file's
/// name.
[[nodiscard]] hal::Fault ReadPng(const std::string& file, GreyImage& image);

/// Writes 8-bit grey (channels = 1) or RGB (channels = 3).
[[nodiscard]] hal::Fault WritePng(const std::string& file, int width_px, int height_px,
                                  int channels, std::span<const std::uint8_t> pixels);

}  // namespace disflow::host
