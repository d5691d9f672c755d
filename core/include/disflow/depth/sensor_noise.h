// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "disflow/depth/block_contrasts.h"
#include "disflow/depth/block_grid.h"
#include "disflow/depth/inverse_depth_block.h"
#include "disflow/memory/median.h"

namespace disflow {

/// Standard deviation of a sensor's inverse depth, 1/m per pixel, from one frame.
class SensorNoise {
 public:
  /// Sensor noise of 1/z per pixel: the median residual of small windows, which curvature and
  /// creases hardly disturb.
  template <class Grid>
  [[nodiscard]] float PixelNoise(const Grid& grid) noexcept {
    // A block of fewer than 4x4 pixels leaves too few degrees of freedom by itself.
    const BlockWindow window =
        grid.block_px() >= 4 ? BlockWindow{0, 0, 0, 0} : BlockWindow{0, 1, 0, 1};
    int count = 0;
    const int stride = std::max(1, grid.columns() * grid.rows() / kNoiseBlocks);
    for (int i = 0; i < grid.columns() * grid.rows() && count < kNoiseBlocks; i += stride) {
      const int column = i % grid.columns();
      const int row = i / grid.columns();
      const float full = static_cast<float>(grid.block_px() * grid.block_px() *
                                            (window.row_max + 1) * (window.column_max + 1));
      const PixelMoments sum = grid.MergeWindow(column, row, window);
      if (sum.n < 0.8F * full) continue;
      const InverseDepthPlane plane = InverseDepthPlane::Fit(sum);
      if (plane.valid) residuals_[static_cast<std::size_t>(count++)] = plane.residual_variance;
    }
    return std::sqrt(MedianResidual(count));
  }

  /// The noise per pixel that explains how far the means of blocks scatter: larger than that of
  /// single pixels where neighbouring pixels err alike, as with any real sensor.
  /// @tparam kSide Edge of the blocks that are compared, in blocks of the grid.
  template <int kSide, class Grid>
  [[nodiscard]] float BlockNoise(const Grid& grid) noexcept {
    constexpr int kMinWindows = 8;
    const auto pixels = static_cast<float>(kSide * kSide * grid.block_px() * grid.block_px());
    // The widest windows overlap the most and cost the most.
    constexpr int kMostWindows = kSide < 3 ? kNoiseBlocks : kNoiseBlocks / 4;
    int count = 0;
    const int stride = std::max(1, grid.columns() * grid.rows() / kMostWindows);
    for (int i = 0; i < grid.columns() * grid.rows() && count < kMostWindows; i += stride) {
      BlockMeans means;
      if (!MeansOf<kSide>(grid, i % grid.columns(), i / grid.columns(), pixels, means)) continue;
      residuals_[static_cast<std::size_t>(count++)] = ThirdOrderVariance(means);
    }
    return count < kMinWindows ? 0.0F
                               : std::sqrt(MedianResidual(count) / kThirdOrderMedian * pixels);
  }

 private:
  /// The means of a window of 3x3 squares, each of kSide x kSide blocks.
  /// @param pixels Of a square.
  /// @return false unless all squares are in the grid and full.
  template <int kSide, class Grid>
  [[nodiscard]] static bool MeansOf(const Grid& grid, int column, int row, float pixels,
                                    BlockMeans& means) noexcept {
    constexpr float kFull = 0.9F;
    if (column + 3 * kSide > grid.columns() || row + 3 * kSide > grid.rows()) return false;
    for (int k = 0; k < 9; ++k) {
      float n = 0.0F;
      float w = 0.0F;
      for (int i = 0; i < kSide * kSide; ++i) {
        const PixelMoments& block =
            grid.block(column + kSide * (k % 3) + i % kSide, row + kSide * (k / 3) + i / kSide);
        n += block.n;
        w += block.SumOfW();
      }
      if (n < kFull * pixels) return false;
      means[static_cast<std::size_t>(k)] = w / n;
    }
    return true;
  }

  /// Of the first ones; 0 if there are none.
  [[nodiscard]] float MedianResidual(int count) noexcept {
    return MedianOf(residuals_.data(), residuals_.data() + count);
  }

  static constexpr int kNoiseBlocks = 512;
  std::array<float, static_cast<std::size_t>(kNoiseBlocks)> residuals_;
};

}  // namespace disflow
