// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "disflow/depth/depth_frame.h"
#include "file_in_memory.h"

namespace disflow::fuzz {

/// Reads every pixel: the sanitizers see what lies outside.
inline void CheckDepth(const DepthView& depth) {
  Require(depth.width_px > 0 && depth.height_px > 0);
  Require(depth.stride_bytes >= std::ptrdiff_t{depth.width_px} * depth.bytes_per_pixel());
  std::size_t sum = 0;
  for (int v = 0; v < depth.height_px; ++v) {
    for (int i = 0; i < depth.width_px * depth.bytes_per_pixel(); ++i) {
      sum += std::to_integer<std::size_t>(depth.row(v)[i]);
    }
  }
  Require(sum <= 255U * static_cast<std::size_t>(depth.stride_bytes * depth.height_px));
}

}  // namespace disflow::fuzz
