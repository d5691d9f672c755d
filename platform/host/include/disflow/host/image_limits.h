// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow::host {

/// Longest side of an image that is read from a file. Files that claim more are damaged or hostile;
/// the bound is checked before anything is allocated.
inline constexpr unsigned kMaxImageSide_px = 8192;

}  // namespace disflow::host
