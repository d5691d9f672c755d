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
  template <class Grid>
  [[nodiscard]] float BlockNoise(const Grid& grid) noexcept {
    constexpr int kMinWindows = 8;
    constexpr float kFull = 0.9F;
    const auto pixels = static_cast<float>(grid.block_px() * grid.block_px());
    int count = 0;
    const int stride = std::max(1, grid.columns() * grid.rows() / kNoiseBlocks);
    for (int i = 0; i < grid.columns() * grid.rows() && count < kNoiseBlocks; i += stride) {
      const int column = i % grid.columns();
      const int row = i / grid.columns();
      if (!grid.HasRing(column, row)) continue;
      BlockMeans means;
      float fewest = pixels;
      for (int k = 0; k < 9; ++k) {
        const PixelMoments& moments = grid.block(column + k % 3 - 1, row + k / 3 - 1);
        fewest = std::min(fewest, moments.n);
        means[static_cast<std::size_t>(k)] =
            moments.w_reference + moments.w / std::max(moments.n, 1.0F);
      }
      if (fewest < kFull * pixels) continue;
      residuals_[static_cast<std::size_t>(count++)] = ThirdOrderVariance(means);
    }
    return count < kMinWindows ? 0.0F
                               : std::sqrt(MedianResidual(count) / kThirdOrderMedian * pixels);
  }

 private:
  /// Of the first ones; 0 if there are none.
  [[nodiscard]] float MedianResidual(int count) noexcept {
    return MedianOf(residuals_.data(), residuals_.data() + count);
  }

  static constexpr int kNoiseBlocks = 512;
  std::array<float, static_cast<std::size_t>(kNoiseBlocks)> residuals_;
};

}  // namespace disflow
