// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/whole_windows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "disflow/depth/whole_windows_impl.h"

namespace disflow {
namespace {

/// Blocks of noise, some of them without pixels.
class Grid {
 public:
  explicit Grid(double filled) {
    std::mt19937 random(1);
    std::bernoulli_distribution has_pixels(filled);
    std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
    for (PixelMoments& block : blocks_) {
      block = {};
      if (!has_pixels(random)) continue;
      for (float* sum : {&block.u, &block.v, &block.w, &block.uu, &block.uv, &block.vv, &block.uw,
                         &block.vw, &block.ww})
        *sum = uniform(random);
      block.n = 20.0F + 5.0F * uniform(random);
      block.w_reference = 2.0F + 0.1F * uniform(random);
    }
  }
  [[nodiscard]] int columns() const { return 21; }
  [[nodiscard]] int rows() const { return 7; }
  [[nodiscard]] int block_px() const { return 5; }
  [[nodiscard]] const PixelMoments& block(int column, int row) const {
    return blocks_[static_cast<std::size_t>(row * columns() + column)];
  }
  [[nodiscard]] bool Has(int column, int row) const {
    return column >= 0 && row >= 0 && column < columns() && row < rows();
  }

 private:
  std::vector<PixelMoments> blocks_{static_cast<std::size_t>(21 * 7)};
};

/// One block after the other.
PixelMoments Merged(const Grid& grid, int column, int row) {
  PixelMoments sum = grid.block(column, row);
  for (int r = row - 1; r <= row + 1; ++r) {
    for (int c = column - 1; c <= column + 1; ++c) {
      if (!grid.Has(c, r) || (c == column && r == row)) continue;
      sum.Merge(grid.block(c, r), 5.0F * static_cast<float>(c - column),
                5.0F * static_cast<float>(r - row));
    }
  }
  return sum;
}

TEST(WholeWindows, SumsOfManyAtOnce_AreThoseOfEach) {
  for (const double filled : {1.0, 0.7}) {
    const Grid grid(filled);
    WholeWindows windows;
    for (int row = 0; row < grid.rows(); ++row) {
      for (int first = 0; first < grid.columns(); first += WholeWindows::kMost) {
        const int count = std::min(WholeWindows::kMost, grid.columns() - first);
        windows.Merge(grid, first, row, count);
        for (int i = 0; i < count; ++i) {
          if (grid.block(first + i, row).n == 0.0F) continue;
          const PixelMoments sum = windows.at(i).sums;
          const PixelMoments expected = Merged(grid, first + i, row);
          EXPECT_EQ(sum.n, expected.n);
          EXPECT_EQ(sum.u, expected.u);
          EXPECT_EQ(sum.uv, expected.uv);
          EXPECT_EQ(sum.vw, expected.vw);
          EXPECT_EQ(sum.ww, expected.ww);
          EXPECT_EQ(sum.w_reference, expected.w_reference);
        }
      }
    }
  }
}

TEST(WholeWindows, WindowThatReachesOutOfTheGrid_HasABlockWithoutPixels) {
  const Grid grid(1.0);
  WholeWindows windows;
  windows.Merge(grid, 0, 1, 3);
  EXPECT_EQ(windows.at(0).bends.fewest, 0.0F);
  EXPECT_GT(windows.at(1).bends.fewest, 0.0F);
  windows.Merge(grid, 1, grid.rows() - 1, 1);
  EXPECT_EQ(windows.at(0).bends.fewest, 0.0F);
}

}  // namespace
}  // namespace disflow
