// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "disflow/depth/inverse_depth_block.h"

namespace disflow {

/// Sums over the pixels of a row of blocks, column by column. Rows of the image are added whole, in
/// loops that compilers use vector instructions on; what is left to do per block costs about as
/// much as one of its rows.
template <int kMaxWidth>
class ColumnSums {
 public:
  using Row = std::array<float, static_cast<std::size_t>(kMaxWidth)>;

  /// Begins `width_px` columns of blocks of `block_px`.
  void Start(int width_px, int block_px) noexcept {
    width_px_ = width_px;
    block_px_ = block_px;
    for (Row* sums : {&n_, &v_, &vv_, &w_, &vw_, &ww_, &reference_})
      std::fill_n(sums->begin(), width_px, 0.0F);
  }

  /// Adds a row of pixels.
  /// @param dv Of the row from the blocks' middle.
  /// @param depth_m 0 where no pixel is to be added. Inverse afterwards [1/m].
  /// @return How many were added.
  int AddRow(float dv, Row& depth_m) noexcept {
    const auto width = static_cast<std::size_t>(width_px_);
    int added = 0;
    for (std::size_t i = 0; i < width; ++i) {
      // Without a branch around the division, for vector instructions.
      const int here = int{depth_m[i] > 0.0F};
      const float divisor_m = here != 0 ? depth_m[i] : 1.0F;
      here_[i] = static_cast<float>(here);
      depth_m[i] = here_[i] / divisor_m;
      added += here;
    }
    ReferTo(depth_m);
    for (std::size_t i = 0; i < width; ++i) {
      const float dw = here_[i] * (depth_m[i] - reference_[i]);
      n_[i] += here_[i];
      v_[i] += here_[i] * dv;
      vv_[i] += here_[i] * (dv * dv);
      w_[i] += dw;
      vw_[i] += dv * dw;
      ww_[i] += dw * dw;
    }
    return added;
  }

  /// The sums over a block; the last one may be cut by the end of the columns.
  [[nodiscard]] PixelMoments Block(int block) const noexcept {
    const int first = block * block_px_;
    const float half = 0.5F * static_cast<float>(block_px_ - 1);
    const int columns = std::min(block_px_, width_px_ - first);
    PixelMoments sum{};
    sum.w_reference = reference_[static_cast<std::size_t>(first)];
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
  /// Inverse depths are summed up relative to that of their block's first pixel, so that float
  /// suffices.
  void ReferTo(const Row& inverse_depth) noexcept {
    for (int begin = 0; begin < width_px_; begin += block_px_) {
      if (reference_[static_cast<std::size_t>(begin)] > 0.0F) continue;
      const int end = std::min(begin + block_px_, width_px_);
      const auto* const last = inverse_depth.begin() + end;
      const auto* const first = std::find_if(inverse_depth.begin() + begin, last,
                                             [](float value) { return value > 0.0F; });
      if (first != last) std::fill(reference_.begin() + begin, reference_.begin() + end, *first);
    }
  }

  // Of each column's pixels, as in PixelMoments; u is the same for all of them.
  Row n_;
  Row v_;
  Row vv_;
  Row w_;
  Row vw_;
  Row ww_;
  Row here_;       ///< Of the last row: 1 where a pixel was added, else 0.
  Row reference_;  ///< The same for all columns of a block; 0 as long as it has no pixel [1/m].
  int width_px_ = 0;
  int block_px_ = 1;
};

}  // namespace disflow
