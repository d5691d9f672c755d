// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/column_sums.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace disflow {
namespace {

constexpr int kWidth_px = 61;
using Sums = ColumnSums<kWidth_px>;
using Row = std::array<float, static_cast<std::size_t>(kWidth_px)>;

/// Sums over one block, pixel by pixel, in double and about the depth that the block's sums are
/// about.
struct Expected {
  double n = 0, u = 0, v = 0, w = 0, uu = 0, uv = 0, vv = 0, uw = 0, vw = 0, ww = 0;

  void Add(double du, double dv, double dw) {
    n += 1;
    u += du;
    v += dv;
    w += dw;
    uu += du * du;
    uv += du * dv;
    vv += dv * dv;
    uw += du * dw;
    vw += dv * dw;
    ww += dw * dw;
  }
};

/// Adds rows of pixels, stretch by stretch.
void AddRows(const std::vector<Row>& rows, float dv, Sums& sums) {
  const int count = static_cast<int>(rows.size());
  for (int v = 0; v < count; v += Sums::kMaxRows) {
    const int together = std::min(Sums::kMaxRows, count - v);
    for (int u = 0; u < kWidth_px; u += sums.StretchWidth(u)) {
      const int width = sums.StretchWidth(u);
      for (int r = 0; r < together; ++r)
        std::copy_n(rows[static_cast<std::size_t>(v + r)].begin() + u, width, sums.stretch_row(r));
      sums.AddStretch(u, width, together, dv + static_cast<float>(v));
    }
  }
}

/// A slanted surface with holes.
std::vector<Row> MakeRows(int count, double share, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution has_depth(share);
  std::normal_distribution<float> noise(0.0F, 0.002F);
  std::vector<Row> rows(static_cast<std::size_t>(count));
  for (std::size_t v = 0; v < rows.size(); ++v) {
    for (std::size_t u = 0; u < rows[v].size(); ++u) {
      const float depth_m = 0.7F + 0.001F * static_cast<float>(u) + 0.002F * static_cast<float>(v);
      rows[v][u] = has_depth(random) ? depth_m + noise(random) : 0.0F;
    }
  }
  return rows;
}

void ExpectSums(const PixelMoments& sum, const Expected& expected, int block_px) {
  EXPECT_EQ(sum.n, static_cast<float>(expected.n)) << block_px;
  EXPECT_EQ(sum.u, static_cast<float>(expected.u)) << block_px;
  EXPECT_EQ(sum.v, static_cast<float>(expected.v)) << block_px;
  EXPECT_EQ(sum.uu, static_cast<float>(expected.uu)) << block_px;
  EXPECT_EQ(sum.uv, static_cast<float>(expected.uv)) << block_px;
  EXPECT_EQ(sum.vv, static_cast<float>(expected.vv)) << block_px;
  // Rounding grows with what is added up.
  const double scale = 1.0 + expected.n / 256.0;
  EXPECT_NEAR(static_cast<double>(sum.w), expected.w, 1e-5 * scale) << block_px;
  EXPECT_NEAR(static_cast<double>(sum.uw), expected.uw, 1e-4 * scale) << block_px;
  EXPECT_NEAR(static_cast<double>(sum.vw), expected.vw, 1e-4 * scale) << block_px;
  EXPECT_NEAR(static_cast<double>(sum.ww), expected.ww, 1e-6 * scale) << block_px;
}

TEST(ColumnSums, BlocksOfAnySizeAndFilling_HaveTheSumsOfTheirPixels) {
  for (const int block_px : {1, 2, 3, 5, 8, 16, 24}) {
    for (const double share : {1.0, 0.6, 0.03, 0.0}) {
      const auto rows = MakeRows(block_px, share, static_cast<unsigned>(block_px));
      const float half = 0.5F * static_cast<float>(block_px - 1);
      Sums sums;
      sums.Start(kWidth_px, block_px);
      AddRows(rows, -half, sums);
      for (int block = 0; block * block_px < kWidth_px; ++block) {
        const PixelMoments sum = sums.Block(block);
        Expected expected;
        for (int v = 0; v < block_px; ++v) {
          for (int u = block * block_px; u < std::min((block + 1) * block_px, kWidth_px); ++u) {
            const float z = rows[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)];
            if (!(z > 0.0F)) continue;
            expected.Add(static_cast<double>(static_cast<float>(u - block * block_px) - half),
                         static_cast<double>(static_cast<float>(v) - half),
                         1.0 / static_cast<double>(z) - static_cast<double>(sum.w_reference));
          }
        }
        ExpectSums(sum, expected, block_px);
      }
    }
  }
}

TEST(ColumnSums, BlocksReferToADepthOfTheirOwn) {
  constexpr int kBlock_px = 4;
  Sums sums;
  sums.Start(kWidth_px, kBlock_px);
  std::vector<Row> rows;
  for (const float depth_m : {0.0F, 0.5F, 2.0F}) {
    rows.emplace_back().fill(depth_m);
    rows.back()[0] = 0.0F;
  }
  AddRows(rows, 0.0F, sums);
  for (int block = 0; block < kWidth_px / kBlock_px; ++block)
    EXPECT_EQ(sums.Block(block).w_reference, 2.0F) << block;
}

TEST(ColumnSums, StartedAnew_ForgetsWhatWasAdded) {
  Sums sums;
  for (int round = 0; round < 2; ++round) {
    sums.Start(kWidth_px, 5);
    Row row;
    row.fill(1.0F);
    AddRows({row}, 0.0F, sums);
  }
  EXPECT_EQ(sums.Block(0).n, 5.0F);
}

}  // namespace
}  // namespace disflow
