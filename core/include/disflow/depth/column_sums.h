// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>

#include "disflow/depth/inverse_depth_block.h"

namespace disflow {

/// Sums over the pixels of a row of blocks, column by column. A stretch of some rows is added at a
/// time, four columns side by side, whose sums meanwhile stay in registers; what is left to do per
/// block costs about as much as one of its rows.
template <int kMaxWidth>
class ColumnSums {
 public:
  static constexpr int kMaxRows = 8;         ///< Of a stretch.
  static constexpr int kMaxStretch_px = 64;  ///< Its width.

  /// Begins `width_px` columns of blocks of `block_px`.
  void Start(int width_px, int block_px) noexcept {
    width_px_ = width_px;
    block_px_ = block_px;
    for (Row* sums : {&n_, &v_, &vv_, &w_, &vw_, &ww_, &reference_})
      std::fill_n(sums->begin(), width_px + kLanes, 0.0F);
  }

  /// The columns of the next stretch: whole blocks, if they are small enough.
  /// @param begin Its first column.
  [[nodiscard]] int StretchWidth(int begin) const noexcept {
    const int blocks = std::max(kMaxStretch_px / block_px_, 1);
    return std::min({blocks * block_px_, kMaxStretch_px, width_px_ - begin});
  }

  /// Where the depths of a stretch's row are put, kMaxStretch_px at most; 0 where no pixel is to be
  /// added [m].
  [[nodiscard]] float* stretch_row(int row) noexcept {
    return inverse_[static_cast<std::size_t>(row)].data();
  }

  /// Adds a stretch.
  /// @param begin Its first column.
  /// @param dv Of its first row from the blocks' middle.
  void AddStretch(int begin, int width, int rows, float dv) noexcept {
    for (int row = 0; row < rows; ++row) Invert(row, width);
    Refer(begin, width, rows);
    for (int i = 0; i < width; i += kLanes) AddColumns(begin, i, rows, dv);
  }

  /// The sums over a block; the last one may be cut by the end of the columns.
  [[nodiscard]] PixelMoments Block(int block) const noexcept {
    const int first = block * block_px_;
    const float half = 0.5F * static_cast<float>(block_px_ - 1);
    const int columns = std::min(block_px_, width_px_ - first);
    PixelMoments sum{};
    sum.w_reference = reference_[static_cast<std::size_t>(first)];
    if (sum.w_reference == 0.0F) return sum;  // no pixel
    for (int column = 0; column < columns; ++column) {
      const auto i = static_cast<std::size_t>(first + column);
      const float du = static_cast<float>(column) - half;
      sum.n += n_[i];
      sum.u += du * n_[i];
      sum.v += v_[i];
      sum.w += w_[i];
      sum.uu += du * du * n_[i];
      sum.uv += du * v_[i];
      sum.vv += vv_[i];
      sum.uw += du * w_[i];
      sum.vw += vw_[i];
      sum.ww += ww_[i];
    }
    return sum;
  }

 private:
  static constexpr int kLanes = 4;
  using Lanes = Eigen::Array<float, kLanes, 1>;
  /// The last lanes may go beyond what they are wanted for.
  using Row = std::array<float, static_cast<std::size_t>(kMaxWidth + kLanes)>;
  using StretchRow = std::array<float, static_cast<std::size_t>(kMaxStretch_px + kLanes)>;

  /// Makes inverse depths of a row's depths, and notes where there are any.
  void Invert(int row, int width) noexcept {
    StretchRow& inverse = inverse_[static_cast<std::size_t>(row)];
    StretchRow& here = here_[static_cast<std::size_t>(row)];
    std::fill_n(inverse.begin() + width, kLanes, 0.0F);
    const auto count = static_cast<std::size_t>(width + kLanes);
    for (std::size_t i = 0; i < count; ++i) {
      // Without a branch around the division, for vector instructions.
      const float any = inverse[i] > 0.0F ? 1.0F : 0.0F;
      here[i] = any;
      inverse[i] = any / (inverse[i] + (1.0F - any));
    }
  }

  /// Inverse depths are summed up relative to that of their block's first pixel, so that float
  /// suffices.
  void Refer(int begin, int width, int rows) noexcept {
    for (int i = 0; i < width;) {
      const int block_end = std::min((begin + i) / block_px_ * block_px_ + block_px_, width_px_);
      const int end = std::min(block_end - begin, width);
      if (reference_[static_cast<std::size_t>(begin + i)] == 0.0F) {
        const float first = FirstIn(i, end, rows);
        std::fill(reference_.begin() + begin + i, reference_.begin() + block_end, first);
      }
      i = end;
    }
  }

  /// The first inverse depth in columns of the stretch, row by row; 0 if there is none.
  [[nodiscard]] float FirstIn(int begin, int end, int rows) const noexcept {
    for (int row = 0; row < rows; ++row) {
      const StretchRow& inverse = inverse_[static_cast<std::size_t>(row)];
      for (int i = begin; i < end; ++i) {
        if (inverse[static_cast<std::size_t>(i)] > 0.0F)
          return inverse[static_cast<std::size_t>(i)];
      }
    }
    return 0.0F;
  }

  /// Adds some columns of all rows of the stretch.
  void AddColumns(int begin, int at, int rows, float dv) noexcept {
    const auto sums = [place = begin + at](Row& row) {
      return Eigen::Map<Lanes>(row.data() + place);
    };
    const auto read = [at](const StretchRow& row) {
      return Lanes(Eigen::Map<const Lanes>(row.data() + at));
    };
    const Lanes reference = sums(reference_);
    Lanes n = sums(n_);
    Lanes v = sums(v_);
    Lanes vv = sums(vv_);
    Lanes w = sums(w_);
    Lanes vw = sums(vw_);
    Lanes ww = sums(ww_);
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row, dv += 1.0F) {
      const Lanes here = read(here_[row]);
      const Lanes dw = here * (read(inverse_[row]) - reference);
      n += here;
      v += here * dv;
      vv += here * (dv * dv);
      w += dw;
      vw += dv * dw;
      ww += dw * dw;
    }
    sums(n_) = n;
    sums(v_) = v;
    sums(vv_) = vv;
    sums(w_) = w;
    sums(vw_) = vw;
    sums(ww_) = ww;
  }

  // Of each column's pixels, as in PixelMoments; u is the same for all of them.
  Row n_;
  Row v_;
  Row vv_;
  Row w_;
  Row vw_;
  Row ww_;
  Row reference_;  ///< The same for all columns of a block; 0 as long as it has no pixel [1/m].
  /// Of the stretch: inverse depths, and 1 where there is one, else 0.
  std::array<StretchRow, static_cast<std::size_t>(kMaxRows)> inverse_;
  std::array<StretchRow, static_cast<std::size_t>(kMaxRows)> here_;
  int width_px_ = 0;
  int block_px_ = 1;
};

}  // namespace disflow
