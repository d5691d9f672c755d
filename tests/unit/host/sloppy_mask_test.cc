// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/sloppy_mask.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace disflow::host {
namespace {

constexpr int kWidth_px = 60;
constexpr int kHeight_px = 50;

using Mask = std::vector<std::uint8_t>;

/// Pixels [u0, u1) x [v0, v1).
Mask Rectangle(int u0, int u1, int v0, int v1) {
  Mask mask(kWidth_px * kHeight_px);
  for (int v = std::max(v0, 0); v < std::min(v1, kHeight_px); ++v) {
    for (int u = std::max(u0, 0); u < std::min(u1, kWidth_px); ++u) {
      mask[static_cast<std::size_t>(v * kWidth_px + u)] = 255;
    }
  }
  return mask;
}

Mask MaskOf(const SloppyMask& sloppy) { return {sloppy.mask().begin(), sloppy.mask().end()}; }

TEST(SloppyMask, GrowsAndShrinksInTurnAndIsHeldForThreeFrames) {
  SloppyMask sloppy(kWidth_px, kHeight_px);
  for (int frame = 0; frame < 12; ++frame) {
    sloppy.Update(frame, Rectangle(15 + frame, 40 + frame, 12, 35));
    const int seen = frame / 3 * 3;  // the frame whose mask is still used
    const int grow = seen / 3 % 2 == 0 ? 6 : -6;
    EXPECT_EQ(MaskOf(sloppy), Rectangle(15 + seen - grow, 40 + seen + grow, 12 - grow, 35 + grow))
        << "frame " << frame;
  }
}

TEST(SloppyMask, AtTheImageBorder_StaysInside) {
  SloppyMask sloppy(kWidth_px, kHeight_px);
  sloppy.Update(0, Rectangle(0, 4, 47, 50));
  EXPECT_EQ(MaskOf(sloppy), Rectangle(0, 10, 41, 50));
}

}  // namespace
}  // namespace disflow::host
