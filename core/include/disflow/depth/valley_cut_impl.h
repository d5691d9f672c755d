// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/depth/valley_cut.h"
#include "disflow/memory/fixed_vector.h"
#include "disflow/memory/median.h"

/// @file
/// Definitions of ValleyCut's members; apart, so that tracker.h stays light.

namespace disflow {

template <int kMaxWidth>
void ValleyCut<kMaxWidth>::Start(const DepthReader& depth, const PinholeCamera& camera,
                                 const PixelBox& box, float distance_m) noexcept {
  constexpr float kSecondPerThird = 0.5477F;  // sqrt(6 / 20), from the sums of squared weights
  Forget(box.u_min / kCellPx, (box.u_max - 1) / kCellPx + 1);
  stride_ = 0;
  const float median_per_m = Median(depth, box, [](const Line& w) { return w[0]; });
  if (!(median_per_m > 0.0F)) return;
  const float third_per_m = Median(
      depth, box, [](const Line& w) { return std::abs(w[0] - 3.0F * w[1] + 3.0F * w[2] - w[3]); });
  const float inverse_depth_per_m = distance_m > 0.0F ? 1.0F / distance_m : median_per_m;
  const float reach_cells = kReach_m * inverse_depth_per_m * camera.fx_px / kCellPx;
  stride_ = static_cast<int>(std::lround(
      std::clamp(reach_cells, static_cast<float>(kLeastStride), static_cast<float>(kMostStride))));
  least_per_m_ = kSigmas * kSecondPerThird * third_per_m / kMedianPerSigma;
  least_fold_ = kFold * kCellPx / camera.fx_px;
}

template <int kMaxWidth>
void ValleyCut<kMaxWidth>::operator()(const DepthReader& depth, int v, int u_begin, int u_end,
                                      float* depth_m) noexcept {
  if (stride_ == 0 || u_begin >= u_end) return;
  const int begin = u_begin / kCellPx;
  const int end = (u_end - 1) / kCellPx + 1;
  if (begin != begin_ || end != end_) Forget(begin, end);
  if (v / kCellPx != row_) FlagRow(depth, v / kCellPx);
  for (int u = u_begin; u < u_end; ++u) {
    if (valley_[static_cast<std::size_t>(u / kCellPx)] != 0) depth_m[u - u_begin] = 0.0F;
  }
}

/// Median over lines of four points of the box, along rows and columns.
template <int kMaxWidth>
template <class Value>
float ValleyCut<kMaxWidth>::Median(const DepthReader& depth, const PixelBox& box,
                                   Value&& value) noexcept {
  FixedVector<float, 2 * kMaxLines> values;
  const auto area = static_cast<float>(box.width()) * static_cast<float>(box.height());
  const int step = std::max(2, static_cast<int>(std::ceil(std::sqrt(area / kMaxLines))));
  Line line;
  for (int v = box.v_min + step / 2; v < box.v_max; v += step) {
    for (int u = box.u_min + step / 2; u < box.u_max; u += step) {
      if (ReadLine(depth, u, v, 1, 0, line)) (void)values.push_back(value(line));
      if (ReadLine(depth, u, v, 0, 1, line)) (void)values.push_back(value(line));
    }
  }
  return MedianOf(values.begin(), values.end());
}

/// @return Whether all of its points have depth.
template <int kMaxWidth>
bool ValleyCut<kMaxWidth>::ReadLine(const DepthReader& depth, int u, int v, int du, int dv,
                                    Line& line) noexcept {
  for (float& inverse_depth_per_m : line) {
    inverse_depth_per_m = CellAt(depth, u, v);
    if (inverse_depth_per_m <= 0.0F) return false;
    u += kNoiseStepPx * du;
    v += kNoiseStepPx * dv;
  }
  return true;
}

/// Mean inverse depth of 2 x 2 pixels; 0 if one has none.
template <int kMaxWidth>
float ValleyCut<kMaxWidth>::CellAt(const DepthReader& depth, int u, int v) noexcept {
  float sum = 0.0F;
  for (int k = 0; k < kCellPx * kCellPx; ++k) {
    const float depth_m = depth.AtOrZero(u + k % kCellPx, v + k / kCellPx);
    if (depth_m <= 0.0F) return 0.0F;
    sum += 1.0F / depth_m;
  }
  return sum / (kCellPx * kCellPx);
}

/// Nothing is held; next come rows of the columns [begin, end).
template <int kMaxWidth>
void ValleyCut<kMaxWidth>::Forget(int begin, int end) noexcept {
  begin_ = begin;
  end_ = end;
  row_ = kNoRow;
  held_.fill(kNoRow);
}

template <int kMaxWidth>
void ValleyCut<kMaxWidth>::FlagRow(const DepthReader& depth, int row) noexcept {
  row_ = row;
  std::fill(valley_.begin() + begin_, valley_.begin() + end_, std::uint8_t{0});
  const Cells& here = CellsOf(depth, row);
  // The shorter stride sees what is close beside an outline or a hole.
  for (const int stride : {stride_, std::max(stride_ / 2, kLeastStride)})
    FlagFolds(stride, CellsOf(depth, row - stride), here, CellsOf(depth, row + stride));
}

/// Without branches, so that compilers use vector instructions.
template <int kMaxWidth>
void ValleyCut<kMaxWidth>::FlagFolds(int stride, const Cells& above_per_m, const Cells& here_per_m,
                                     const Cells& below_per_m) noexcept {
  const float least_per_m = least_per_m_;
  const float least_fold = least_fold_ * static_cast<float>(stride);
  const float* here = At(here_per_m, begin_);
  const float* left = At(here_per_m, begin_ - stride);
  const float* right = At(here_per_m, begin_ + stride);
  const float* above = At(above_per_m, begin_);
  const float* below = At(below_per_m, begin_);
  std::uint8_t* valley = valley_.data() + begin_;
  const int count = end_ - begin_;
  for (int i = 0; i < count; ++i) {
    const float fold = least_fold * here[i];
    const float least = 2.0F * here[i] + (fold > least_per_m ? fold : least_per_m);
    const int across = int{left[i] > 0.0F} & int{right[i] > 0.0F} & int{left[i] + right[i] > least};
    const int along =
        int{above[i] > 0.0F} & int{below[i] > 0.0F} & int{above[i] + below[i] > least};
    const int folds = int{here[i] > 0.0F} & (across | along);
    valley[i] = static_cast<std::uint8_t>(valley[i] | folds);
  }
}

/// A row, read unless it is held. Takes the place of the one kRows away, too far to be compared
/// with any that this one is.
template <int kMaxWidth>
auto ValleyCut<kMaxWidth>::CellsOf(const DepthReader& depth, int row) noexcept -> const Cells& {
  const auto place = static_cast<std::size_t>((row + kRows) % kRows);  // above the image row < 0
  if (held_[place] != row) {
    held_[place] = row;
    ReadCells(depth, row, cells_[place]);
  }
  return cells_[place];
}

/// Cells of a row and a stride beside; beyond the image 0, without depth not positive.
template <int kMaxWidth>
void ValleyCut<kMaxWidth>::ReadCells(const DepthReader& depth, int row, Cells& cells) noexcept {
  const int begin = begin_ - stride_;
  const int end = end_ + stride_;
  std::fill(At(cells, begin), At(cells, end), 0.0F);
  if (row < 0 || row >= depth.height_px() / kCellPx) return;
  const int first = std::max(begin, 0);
  const int last = std::min(end, depth.width_px() / kCellPx);
  float* out = At(cells, first);
  for (int k = 0; k < kCellPx && first < last; ++k) {
    depth.ReadRow(row * kCellPx + k, first * kCellPx, last * kCellPx, pixels_m_.data());
    for (int i = 0; i < last - first; ++i) {
      const float a_m = pixels_m_[static_cast<std::size_t>(kCellPx * i)];
      const float b_m = pixels_m_[static_cast<std::size_t>(kCellPx * i + 1)];
      const bool both = a_m > 0.0F && b_m > 0.0F;
      out[i] += both ? (1.0F / a_m + 1.0F / b_m) / (kCellPx * kCellPx) : kNone;
    }
  }
}

}  // namespace disflow
