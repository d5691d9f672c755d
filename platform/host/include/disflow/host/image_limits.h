// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace disflow::host {

/// Longest side of an image that is read from a file. Files that claim more are damaged or hostile;
/// the bound is checked before anything is allocated.
inline constexpr unsigned kMaxImageSide_px = 8192;
/// The same for all of its pixels: sixteen million, so that no buffer for one is larger than 64 MB.
inline constexpr std::uint64_t kMaxImagePixels = std::uint64_t{1} << 24U;

}  // namespace disflow::host
