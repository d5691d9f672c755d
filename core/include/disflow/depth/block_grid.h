// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "disflow/config.h"
#include "disflow/depth/column_sums.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/inverse_depth_block.h"
#include "disflow/depth/pixel_row.h"

namespace disflow {

/// A rectangle of blocks around one of them.
struct BlockWindow {
  int column_min, column_max, row_min, row_max;  // offsets in blocks, both included
};
/// The whole neighbourhood first, then the halves and the quarters that contain the block itself.
inline constexpr std::array<BlockWindow, 9> kBlockWindows{{{-1, 1, -1, 1},
                                                           {-1, 0, -1, 1},
                                                           {0, 1, -1, 1},
                                                           {-1, 1, -1, 0},
                                                           {-1, 1, 0, 1},
                                                           {-1, 0, -1, 0},
                                                           {0, 1, -1, 0},
                                                           {-1, 0, 0, 1},
                                                           {0, 1, 0, 1}}};

/// Sums of the object's pixels per small block. The grid of blocks covers the object's bounding
/// box; sums are kept only for blocks that hold pixels.
template <class Limits>
class BlockGrid {
 public:
  using Sums = ColumnSums<Limits::kMaxImageWidth>;
  static constexpr std::uint16_t kNoSample = 65535;

  /// Blocks as small as the number of samples allows.
  /// @param interior Object pixels away from the outline.
  /// @param least_px Their edge at least.
  /// @param sums Memory for the time being.
  /// @return How many of them have no depth.
  template <class Mask>
  int Build(const DepthReader& depth, const Mask& interior, const SamplerConfig& config,
            int least_px, Sums& sums) noexcept {
    ChooseBlockSize(interior, config);
    block_px_ = std::max(block_px_, std::min(least_px, config.max_block_px));
    int without_depth = 0;
    while (!LayOutGrid(interior.box()) || !SumBlocks(depth, interior, sums, without_depth))
      ++block_px_;
    return without_depth;
  }

  [[nodiscard]] int block_px() const noexcept { return block_px_; }
  [[nodiscard]] int columns() const noexcept { return columns_; }
  [[nodiscard]] int rows() const noexcept { return rows_; }
  /// Middle of a block whose pixels are all there, image coordinates.
  [[nodiscard]] float CenterU(int column) const noexcept {
    return static_cast<float>(origin_u_ + column * block_px_) +
           0.5F * static_cast<float>(block_px_ - 1);
  }
  [[nodiscard]] float CenterV(int row) const noexcept {
    return static_cast<float>(origin_v_ + row * block_px_) +
           0.5F * static_cast<float>(block_px_ - 1);
  }
  [[nodiscard]] const PixelMoments& block(int column, int row) const noexcept {
    return moments_[grid_[Index(column, row)]];
  }
  /// The first column of [begin, end) whose block in a row holds pixels; `end` if there is none.
  [[nodiscard]] int FirstFilled(int begin, int end, int row) const noexcept {
    while (begin < end && grid_[Index(begin, row)] == kEmptyBlock) ++begin;
    return begin;
  }
  /// Over all pixels that have one; 0 if none has [1/m].
  [[nodiscard]] float MeanInverseDepth() const noexcept {
    float n = 0.0F;
    float w = 0.0F;
    for (int i = kEmptyBlock + 1; i < filled_; ++i) {
      const PixelMoments& block = moments_[static_cast<std::size_t>(i)];
      n += block.n;
      w += block.SumOfW();
    }
    return n > 0.0F ? w / n : 0.0F;
  }

  /// The surface sample that was made of a block.
  void SetSample(int column, int row, int sample) noexcept {
    sample_of_[grid_[Index(column, row)]] = static_cast<std::uint16_t>(sample);
  }
  /// That of the block of a pixel; kNoSample if there is none.
  [[nodiscard]] std::uint16_t SampleAt(int u, int v) const noexcept {
    const int column = (u - origin_u_) / block_px_;
    const int row = (v - origin_v_) / block_px_;
    if (u < origin_u_ || v < origin_v_ || column >= columns_ || row >= rows_) return kNoSample;
    return sample_of_[grid_[Index(column, row)]];
  }

  /// Sums over a window, about the middle of its own block.
  [[nodiscard]] PixelMoments MergeWindow(int column, int row,
                                         const BlockWindow& window) const noexcept {
    PixelMoments sum = block(column, row);
    const auto step = static_cast<float>(block_px_);
    for (int r = std::max(row + window.row_min, 0); r <= std::min(row + window.row_max, rows_ - 1);
         ++r) {
      for (int c = std::max(column + window.column_min, 0);
           c <= std::min(column + window.column_max, columns_ - 1); ++c) {
        if (c == column && r == row) continue;
        sum.Merge(block(c, r), step * static_cast<float>(c - column),
                  step * static_cast<float>(r - row));
      }
    }
    return sum;
  }

 private:
  [[nodiscard]] std::size_t Index(int column, int row) const noexcept {
    return static_cast<std::size_t>(row * columns_ + column);
  }

  /// The smallest blocks for which the samples are not too many.
  template <class Mask>
  void ChooseBlockSize(const Mask& interior, const SamplerConfig& config) noexcept {
    const float pixels_per_block =
        static_cast<float>(interior.count()) / static_cast<float>(config.target_blocks);
    block_px_ = std::clamp(static_cast<int>(std::lround(std::sqrt(pixels_per_block))),
                           config.min_block_px, config.max_block_px);
    // Partly covered blocks yield samples too: leave them some room.
    while (1.2F * static_cast<float>(interior.count()) >
           static_cast<float>(Limits::kMaxSurfaceSamples * block_px_ * block_px_))
      ++block_px_;
  }

  /// @return false if the grid has too many blocks.
  [[nodiscard]] bool LayOutGrid(const PixelBox& box) noexcept {
    columns_ = (box.width() + block_px_ - 1) / block_px_;
    rows_ = (box.height() + block_px_ - 1) / block_px_;
    if (columns_ * rows_ > Limits::kMaxBlocks) return false;
    origin_u_ = box.u_min;
    origin_v_ = box.v_min;
    std::fill_n(grid_.begin(), columns_ * rows_, kEmptyBlock);
    moments_[kEmptyBlock] = PixelMoments{};
    sample_of_[kEmptyBlock] = kNoSample;
    filled_ = 1;
    return true;
  }

  /// @return false if too many blocks hold pixels.
  template <class Mask>
  [[nodiscard]] bool SumBlocks(const DepthReader& depth, const Mask& interior, Sums& sums,
                               int& without_depth) noexcept {
    int with_depth = 0;
    for (int row = 0; row < rows_; ++row) {
      SumRow(depth, interior, row, sums);
      for (int column = 0; column < columns_; ++column) {
        const PixelMoments sum = sums.Block(column);
        with_depth += static_cast<int>(sum.n);
        if (!Keep(Index(column, row), sum)) return false;
      }
    }
    without_depth = interior.count() - with_depth;
    return true;
  }

  /// Sums up a row of blocks.
  template <class Mask>
  void SumRow(const DepthReader& depth, const Mask& interior, int row, Sums& sums) noexcept {
    const float half = 0.5F * static_cast<float>(block_px_ - 1);
    const int v_begin = origin_v_ + row * block_px_;
    const int v_end = std::min(v_begin + block_px_, interior.box().v_max);
    sums.Start(interior.box().width(), block_px_);
    for (int v = v_begin; v < v_end; v += Sums::kMaxRows) {
      SumRows(depth, interior, v, std::min(Sums::kMaxRows, v_end - v),
              static_cast<float>(v - v_begin) - half, sums);
    }
  }

  /// Adds some rows of pixels to the sums.
  /// @param dv Of the first one from the blocks' middle.
  template <class Mask>
  void SumRows(const DepthReader& depth, const Mask& interior, int v_begin, int rows, float dv,
               Sums& sums) noexcept {
    std::array<typename Mask::Row, static_cast<std::size_t>(Sums::kMaxRows)> pixels;
    for (int r = 0; r < rows; ++r)
      pixels[static_cast<std::size_t>(r)] = interior.RowAt(v_begin + r);
    const int width = interior.box().width();
    for (int begin = 0; begin < width; begin += sums.StretchWidth(begin)) {
      const int count = sums.StretchWidth(begin);
      const int u = origin_u_ + begin;
      bool any = false;
      for (int r = 0; r < rows; ++r) {
        float* const row_m = sums.stretch_row(r);
        int wanted = count;
        depth.ReadRow(v_begin + r, u, u + count, row_m);
        pixels[static_cast<std::size_t>(r)].ForEachGap(u, u + count, [&](int gap, int gap_end) {
          std::fill(row_m + (gap - u), row_m + (gap_end - u), 0.0F);
          wanted -= gap_end - gap;
        });
        any = any || wanted > 0;
      }
      if (any) sums.AddStretch(begin, count, rows, dv);
    }
  }

  /// @return false if there is no room for more blocks that hold pixels.
  [[nodiscard]] bool Keep(std::size_t place, const PixelMoments& sum) noexcept {
    if (sum.n == 0.0F) return true;
    if (filled_ == kMaxFilledBlocks) return false;
    grid_[place] = static_cast<std::uint16_t>(filled_);
    moments_[static_cast<std::size_t>(filled_)] = sum;
    sample_of_[static_cast<std::size_t>(filled_)] = kNoSample;
    ++filled_;
    return true;
  }

  /// Full blocks and the partly covered ones along the outline.
  static constexpr int kMaxFilledBlocks = Limits::kMaxSurfaceSamples * 5 / 4;
  static_assert(kMaxFilledBlocks <= 65536 && Limits::kMaxSurfaceSamples < 65535);
  static constexpr std::uint16_t kEmptyBlock = 0;

  /// Per block of the grid where its sums are; blocks without pixels share the first.
  std::array<std::uint16_t, static_cast<std::size_t>(Limits::kMaxBlocks)> grid_;
  std::array<PixelMoments, static_cast<std::size_t>(kMaxFilledBlocks)> moments_;
  std::array<std::uint16_t, static_cast<std::size_t>(kMaxFilledBlocks)> sample_of_;
  int filled_ = 0;
  int origin_u_ = 0;
  int origin_v_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  int block_px_ = 1;
};

}  // namespace disflow
