// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <libcamera/pixel_format.h>

#include "disflow/posix/camera/depth_pixel_format.h"

namespace disflow::posix {

/// The format as libcamera names it: DRM's code, and a modifier where it is packed. Built from
/// numbers, since which of them libcamera has names for depends on its version.
[[nodiscard]] inline libcamera::PixelFormat RawFormat(const DepthPixelFormat& format) {
  constexpr std::uint32_t kLastLetter = 0xFFU << 24U;
  constexpr std::uint32_t kBlank = std::uint32_t{' '} << 24U;
  constexpr std::uint64_t kMipiPacked = 0x0B00000000000001;  // DRM's MIPI vendor, packed
  const bool packed = format.conversion != DepthPixelFormat::Conversion::kNone;
  return libcamera::PixelFormat((format.fourcc & ~kLastLetter) | kBlank, packed ? kMipiPacked : 0);
}

/// @return Null if the format is none of depth's.
[[nodiscard]] inline const DepthPixelFormat* DepthFormatOf(const libcamera::PixelFormat& raw) {
  for (const DepthPixelFormat& format : LibcameraDepthFormats()) {
    if (RawFormat(format) == raw) return &format;
  }
  return nullptr;
}

}  // namespace disflow::posix
