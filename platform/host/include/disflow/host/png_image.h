// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// A grey image of 8 or 16 bits per pixel, row-major; 8-bit values are kept as they are.
struct GrayImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> pixels;
};

/// Reads a grey PNG. Colour, palette and transparency are refused, as depth and masks have none,
/// and so is what is no regular file, see CheckRegularFile().
/// @param image Reused, so that reading a sequence does not allocate again; undefined on error.
/// @return kNotFound, kTruncated, kCorrupt, kUnsupported or kIoError, naming the file.
[[nodiscard]] hal::Fault ReadGrayPng(const std::filesystem::path& file, GrayImage& image);
/// The same for the bytes of such a file.
/// @param name What the fault calls it.
[[nodiscard]] hal::Fault ReadGrayPng(std::span<const std::uint8_t> png, const char* name,
                                     GrayImage& image);

/// @param rows 8-bit pixels, `stride_bytes` from row to row.
[[nodiscard]] hal::Fault WriteGray8Png(const std::filesystem::path& file, const std::uint8_t* rows,
                                       int width_px, int height_px, std::ptrdiff_t stride_bytes);
[[nodiscard]] hal::Fault WriteGray16Png(const std::filesystem::path& file,
                                        std::span<const std::uint16_t> pixels, int width_px,
                                        int height_px);
/// The bytes of a PNG file. @param pixels Red, green, blue, 8 bits each.
/// @return Empty if libpng refuses.
[[nodiscard]] std::string EncodeRgbPng(std::span<const std::uint8_t> pixels, int width_px,
                                       int height_px);

}  // namespace disflow::host
