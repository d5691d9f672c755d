// SPDX-License-Identifier: BSD-3-Clause
#include "object_interior.h"

#include <gtest/gtest.h>

#include <vector>

namespace disflow::bench {
namespace {

constexpr int kWidth = 12;
constexpr int kHeight = 10;
constexpr int kBorder = SamplerConfig{}.border_px;

MaskView ViewOf(const std::vector<std::uint8_t>& mask) {
  return {mask.data(), kWidth, kHeight, kWidth, 0};
}

int CountInterior(const MaskView& mask) {
  int count = 0;
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) count += int{IsInterior(mask, u, v)};
  }
  return count;
}

TEST(ObjectInterior, EdgeOfTheImageIsABorderToo) {
  const std::vector<std::uint8_t> all(kWidth * kHeight, 255);
  EXPECT_EQ(CountInterior(ViewOf(all)), (kWidth - 2 * kBorder) * (kHeight - 2 * kBorder));
}

TEST(ObjectInterior, PixelWithinTheBorderOfAHole_IsNone) {
  std::vector<std::uint8_t> mask(kWidth * kHeight, 255);
  mask[5 * kWidth + 6] = 0;
  EXPECT_FALSE(IsInterior(ViewOf(mask), 6 - kBorder, 5));
  EXPECT_FALSE(IsInterior(ViewOf(mask), 6 + kBorder, 5 + kBorder));
  EXPECT_TRUE(IsInterior(ViewOf(mask), 5 - kBorder, 5));
  EXPECT_TRUE(IsInterior(ViewOf(mask), 7 + kBorder, 5));
}

TEST(ObjectInterior, MaskOfSeveralObjects_CountsThoseOfTheLabel) {
  std::vector<std::uint8_t> mask(kWidth * kHeight, 1);
  MaskView view = ViewOf(mask);
  view.label = 2;
  EXPECT_EQ(CountInterior(view), 0);
}

TEST(ObjectInterior, WithoutAMask_IsEverywhere) {
  EXPECT_EQ(CountInterior(MaskView{}), kWidth * kHeight);
}

}  // namespace
}  // namespace disflow::bench
