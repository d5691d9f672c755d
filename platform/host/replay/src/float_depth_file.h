// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// A depth image in metres, row-major.
struct FloatImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> pixels;
};

/// Reads a .float file: u64 width, u64 height (little endian), then float32. The size is checked
/// against the file's length before anything is allocated.
/// @param image Reused from frame to frame; undefined on error.
/// @return kNotFound, kTruncated, kCorrupt or kIoError, naming the file.
[[nodiscard]] hal::Fault ReadFloatDepth(const std::filesystem::path& file, FloatImage& image);

}  // namespace disflow::host
