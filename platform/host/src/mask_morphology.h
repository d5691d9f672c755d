// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace disflow::host {

/// Grows the set pixels (255) of a mask by a square of `reach_px` to all sides, or shrinks them if
/// it is negative.
/// @param rows Scratch of the mask's size.
void SpreadMask(int reach_px, int width_px, int height_px, std::vector<std::uint8_t>& rows,
                std::vector<std::uint8_t>& mask);

}  // namespace disflow::host
