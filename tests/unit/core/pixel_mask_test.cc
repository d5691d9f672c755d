// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/pixel_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/depth/eroded_mask.h"

namespace disflow {
namespace {

constexpr int kWidth_px = 150;  // not a multiple of a word's 64 bits
constexpr int kHeight_px = 40;
using Mask = PixelMask<192, 48>;

/// The same as a mask, pixel by pixel.
class PlainMask {
 public:
  explicit PlainMask(double share, unsigned seed)
      : bytes_(static_cast<std::size_t>(kWidth_px * kHeight_px)) {
    std::mt19937 random(seed);
    std::bernoulli_distribution set(share);
    for (auto& byte : bytes_) byte = set(random) ? std::uint8_t{200} : std::uint8_t{0};
  }
  [[nodiscard]] bool Test(int u, int v) const {
    return u >= 0 && v >= 0 && u < kWidth_px && v < kHeight_px && Row(v)[u] != 0;
  }
  [[nodiscard]] const std::uint8_t* Row(int v) const { return bytes_.data() + v * kWidth_px; }
  /// Whether all (or any) pixels of the square about a pixel are set.
  [[nodiscard]] bool AllAbout(int u, int v, int radius) const {
    return CountAbout(u, v, radius) == (2 * radius + 1) * (2 * radius + 1);
  }
  [[nodiscard]] bool AnyAbout(int u, int v, int radius) const {
    return CountAbout(u, v, radius) > 0;
  }

 private:
  [[nodiscard]] int CountAbout(int u, int v, int radius) const {
    int count = 0;
    for (int dv = -radius; dv <= radius; ++dv) {
      for (int du = -radius; du <= radius; ++du) count += Test(u + du, v + dv) ? 1 : 0;
    }
    return count;
  }
  std::vector<std::uint8_t> bytes_;
};

Mask Packed(const PlainMask& plain) {
  Mask mask;
  mask.Start(kWidth_px, kHeight_px);
  for (int v = 0; v < kHeight_px; ++v) mask.SetFromBytes(v, 0, kWidth_px, plain.Row(v));
  mask.Finish();
  return mask;
}

TEST(PixelMask, Bytes_BecomeTheSamePixels) {
  const PlainMask plain(0.3, 1);
  const Mask mask = Packed(plain);
  int count = 0;
  for (int v = -1; v <= kHeight_px; ++v) {
    for (int u = -1; u <= kWidth_px; ++u) {
      ASSERT_EQ(mask.Test(u, v), plain.Test(u, v)) << u << ' ' << v;
      count += plain.Test(u, v) ? 1 : 0;
    }
  }
  EXPECT_EQ(mask.count(), count);
}

TEST(PixelMask, BytesOfALabel_AreThePixelsOfThatValueOnly) {
  std::mt19937 random(2);
  // Neighbours in value differ in one bit or carry into the next byte if compared carelessly.
  constexpr std::array<std::uint8_t, 7> kValues = {0, 1, 2, 3, 127, 128, 255};
  std::vector<std::uint8_t> bytes(kWidth_px);
  for (auto& byte : bytes) byte = kValues[random() % kValues.size()];
  constexpr std::array<std::uint8_t, 7> kLabels = {1, 2, 3, 127, 128, 255, 77};
  for (const std::uint8_t label : kLabels) {
    for (const auto& [begin, end] : {std::pair{0, kWidth_px}, {5, 140}, {64, 128}, {70, 75}}) {
      Mask mask;
      mask.Start(kWidth_px, kHeight_px);
      mask.SetFromBytes(3, begin, end, bytes.data(), label);
      mask.Finish();
      for (int u = 0; u < kWidth_px; ++u) {
        const bool wanted = u >= begin && u < end && bytes[static_cast<std::size_t>(u)] == label;
        ASSERT_EQ(mask.Test(u, 3), wanted) << u << ", label " << int{label};
      }
    }
  }
}

TEST(PixelMask, PartOfARow_LeavesTheRestUnset) {
  const std::vector<std::uint8_t> ones(kWidth_px, 1);
  Mask mask;
  mask.Start(kWidth_px, kHeight_px);
  mask.SetFromBytes(3, 5, 140, ones.data());
  mask.Finish();
  EXPECT_EQ(mask.count(), 135);
  EXPECT_FALSE(mask.Test(4, 3));
  EXPECT_TRUE(mask.Test(5, 3));
  EXPECT_TRUE(mask.Test(139, 3));
  EXPECT_FALSE(mask.Test(140, 3));
}

TEST(PixelMask, Box_HoldsAllPixelsTightly) {
  Mask mask;
  mask.Start(kWidth_px, kHeight_px);
  mask.row(7).SetRun(60, 71);
  mask.row(12).SetRun(100, 131);
  mask.Finish();
  EXPECT_EQ(mask.box().u_min, 60);
  EXPECT_EQ(mask.box().u_max, 131);
  EXPECT_EQ(mask.box().v_min, 7);
  EXPECT_EQ(mask.box().v_max, 13);
  mask.row(7).ClearRun(60, 71);
  mask.row(12).ClearRun(100, 131);
  mask.Finish();
  EXPECT_TRUE(mask.box().empty());
  EXPECT_EQ(mask.count(), 0);
}

TEST(PixelMask, BitsOfAPartOfARow_AreItsPixels) {
  const PlainMask plain(0.5, 9);
  const Mask mask = Packed(plain);
  MaskView view{plain.Row(0), kWidth_px, kHeight_px, kWidth_px};
  for (const std::uint8_t label : {std::uint8_t{0}, std::uint8_t{200}}) {
    view.label = label;
    for (const int v : {-1, 0, 7, kHeight_px - 1, kHeight_px}) {
      for (int u = -12; u < kWidth_px + 12; ++u) {
        std::uint32_t expected = 0;
        for (int i = 0; i < 9; ++i) expected |= (plain.Test(u + i, v) ? 1U : 0U) << i;
        ASSERT_EQ(mask.BitsIn(v, u, 9), expected) << u << ' ' << v;
        ASSERT_EQ(view.BitsIn(v, u, 9), expected) << u << ' ' << v;
      }
    }
  }
}

TEST(PixelRow, Runs_AreSetCountedAndClearedAcrossWords) {
  for (const auto& [begin, end] : {std::pair{0, 64}, {63, 65}, {1, 190}, {64, 128}, {10, 10}}) {
    PixelRow<192> row;
    row.Clear();
    row.SetRun(begin, end);
    EXPECT_EQ(row.CountRun(0, 192), end - begin);
    for (int u = 0; u < 192; ++u) ASSERT_EQ(row.Test(u), u >= begin && u < end) << u;
    EXPECT_EQ(row.CountRun(begin + 1, end), std::max(end - begin - 1, 0));
    row.ClearRun(begin, end);
    EXPECT_EQ(row.CountRun(0, 192), 0);
  }
}

TEST(PixelRow, Gaps_AreTheStretchesThatAreNotMarked) {
  std::mt19937 random(4);
  std::bernoulli_distribution marked(0.7);
  std::bernoulli_distribution changes(0.1);
  for (int round = 0; round < 50; ++round) {
    PixelRow<192> row;
    row.Clear();
    bool on = marked(random);
    for (int u = 0; u < 192; ++u) {
      if (changes(random)) on = marked(random);
      if (on) row.SetRun(u, u + 1);
    }
    const int begin = round % 70;
    const int end = 192 - round;
    std::vector<bool> in_gap(192, false);
    int last = begin - 1;
    row.ForEachGap(begin, end, [&](int u_begin, int u_end) {
      EXPECT_GT(u_begin, last) << "a gap that goes on, or goes back";
      EXPECT_LT(u_begin, u_end);
      last = u_end;
      std::fill(in_gap.begin() + u_begin, in_gap.begin() + u_end, true);
    });
    for (int u = 0; u < 192; ++u) {
      const bool inside = u >= begin && u < end;
      ASSERT_EQ(in_gap[static_cast<std::size_t>(u)], inside && !row.Test(u)) << u;
    }
  }
}

TEST(ErodedMask, KeepsPixelsWhoseSquareIsSet) {
  const PlainMask plain(0.97, 2);
  const Mask mask = Packed(plain);
  for (const int radius : {0, 1, 3}) {
    const ErodedMask eroded(mask, radius);
    int count = 0;
    for (int v = 0; v < kHeight_px; ++v) {
      std::vector<bool> set(kWidth_px, false);
      if (v >= eroded.box().v_min && v < eroded.box().v_max)
        for (int u = eroded.box().u_min; u < eroded.box().u_max; ++u)
          set[static_cast<std::size_t>(u)] = eroded.RowAt(v).Test(u);
      for (int u = 0; u < kWidth_px; ++u) {
        ASSERT_EQ(set[static_cast<std::size_t>(u)], plain.AllAbout(u, v, radius))
            << u << ' ' << v << " radius " << radius;
        count += plain.AllAbout(u, v, radius) ? 1 : 0;
      }
    }
    EXPECT_EQ(eroded.count(), count);
    EXPECT_GT(count, 0);
  }
}

/// A mask of one rectangle.
Mask Rectangle(int width_px, int height_px) {
  const std::vector<std::uint8_t> row(static_cast<std::size_t>(kWidth_px), 200);
  Mask mask;
  mask.Start(kWidth_px, kHeight_px);
  for (int v = 0; v < height_px; ++v) mask.SetFromBytes(v + 2, 10, 10 + width_px, row.data());
  mask.Finish();
  return mask;
}

TEST(InteriorOf, OfALargeThing_LacksTheWholeBorder) {
  EXPECT_EQ(InteriorOf(Rectangle(120, 36), 1).count(), 118 * 34);
}

TEST(InteriorOf, WithABorderThatCostsTooMuch_LacksANarrowerOne) {
  EXPECT_EQ(InteriorOf(Rectangle(120, 36), 3).count(), 118 * 34);
}

TEST(InteriorOf, OfASmallOrThinThing_IsAllOfIt) {
  EXPECT_EQ(InteriorOf(Rectangle(20, 10), 1).count(), 20 * 10);
  EXPECT_EQ(InteriorOf(Rectangle(120, 8), 2).count(), 120 * 8);
}

TEST(InteriorOf, WithoutABorder_IsTheMask) {
  EXPECT_EQ(InteriorOf(Rectangle(120, 36), 0).count(), 120 * 36);
}

TEST(InteriorOf, OfAnEmptyMask_IsEmpty) { EXPECT_EQ(InteriorOf(Rectangle(0, 0), 1).count(), 0); }

TEST(PixelMask, Outline_IsWhatHasAnUnsetNeighbour) {
  for (const double share : {0.02, 0.5, 0.98, 1.0}) {
    const PlainMask plain(share, 11);
    const Mask mask = Packed(plain);
    for (int v = mask.box().v_min; v < mask.box().v_max; ++v) {
      std::vector<int> expected;
      for (int u = 0; u < kWidth_px; ++u) {
        const bool inner = plain.Test(u - 1, v) && plain.Test(u + 1, v) && plain.Test(u, v - 1) &&
                           plain.Test(u, v + 1);
        if (plain.Test(u, v) && !inner) expected.push_back(u);
      }
      std::vector<int> found;
      mask.ForEachOutlineInRow(v, [&](int u) { found.push_back(u); });
      EXPECT_EQ(found, expected) << "share " << share << ", row " << v;
    }
  }
}

TEST(PixelMask, Closing_FillsWhatADilationFillsAndAnErosionLeaves) {
  const PlainMask plain(0.06, 3);
  Mask mask = Packed(plain);
  constexpr int kRadius = 2;
  mask.Close<kRadius>();
  mask.Finish();
  // Away from the border, where the outside counts as unset.
  for (int v = 2 * kRadius; v < kHeight_px - 2 * kRadius; ++v) {
    for (int u = 2 * kRadius; u < kWidth_px - 2 * kRadius; ++u) {
      bool closed = true;
      for (int dv = -kRadius; dv <= kRadius; ++dv) {
        for (int du = -kRadius; du <= kRadius; ++du)
          closed = closed && plain.AnyAbout(u + du, v + dv, kRadius);
      }
      ASSERT_EQ(mask.Test(u, v), closed) << u << ' ' << v;
    }
  }
  EXPECT_GT(mask.count(), Packed(plain).count());
}

}  // namespace
}  // namespace disflow
