// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "disflow/depth/curved_window.h"
#include "disflow/depth/inverse_depth_block.h"

namespace disflow {

/// Sums over a window of 3x3 blocks, about the middle of its own block.
struct WholeWindow {
  PixelMoments sums;  ///< Undefined if the window's own block holds no pixel.
  CurvedWindow::Sums bends;
};

/// Sums over the windows of 3x3 blocks about some neighbouring blocks of a row: four windows side
/// by side, block by block in the order in which BlockGrid::MergeWindow() takes them.
class WholeWindows {
  static constexpr int kLanes = 4;

 public:
  static constexpr int kMost = 4 * kLanes;

  /// @param grid Has block(column, row), columns() and rows() as BlockGrid.
  /// @param column, row Of the first window's own block.
  /// @param count Of windows, at most kMost.
  template <class Grid>
  void Merge(const Grid& grid, int column, int row, int count) noexcept {
    const int padded = (count + kLanes - 1) / kLanes * kLanes;
    for (int r = 0; r < 3; ++r) {
      for (int i = 0; i < padded + 2; ++i)
        blocks_[Side(r)].Set(i, At(grid, column + i - 1, row + r - 1));
    }
    const auto step_px = static_cast<float>(grid.block_px());
    for (int i = 0; i < count; i += kLanes) MergeLanes(i, step_px);
  }

  [[nodiscard]] WholeWindow at(int i) const noexcept {
    const auto k = static_cast<std::size_t>(i);
    return {sums_.Get(i), {fewest_[k], bends_[0][k], bends_[1][k], bends_[2][k]}};
  }

 private:
  using Lanes = Eigen::Array<float, kLanes, 1>;
  using Row = std::array<float, static_cast<std::size_t>(kMost + kLanes)>;

  /// Blocks of a row, number by number.
  struct Columns {
    MomentsOf<Row> of;

    void Set(int i, const PixelMoments& moments) noexcept {
      ForEachPair(of, moments,
                  [k = static_cast<std::size_t>(i)](Row& row, float value) { row[k] = value; });
    }
    [[nodiscard]] PixelMoments Get(int i) const noexcept {
      PixelMoments moments;
      ForEachPair(moments, of, [k = static_cast<std::size_t>(i)](float& value, const Row& row) {
        value = row[k];
      });
      return moments;
    }
    [[nodiscard]] MomentsOf<Lanes> Read(int i) const noexcept;
    void Write(int i, const MomentsOf<Lanes>& moments) noexcept;
  };

  template <class A, class B, class Visitor>
  static void ForEachPair(A& a, B& b, Visitor&& visit) noexcept {
    visit(a.n, b.n);
    visit(a.u, b.u);
    visit(a.v, b.v);
    visit(a.w, b.w);
    visit(a.uu, b.uu);
    visit(a.uv, b.uv);
    visit(a.vv, b.vv);
    visit(a.uw, b.uw);
    visit(a.vw, b.vw);
    visit(a.ww, b.ww);
    visit(a.w_reference, b.w_reference);
  }

  /// What lies outside of the grid holds no pixel.
  template <class Grid>
  [[nodiscard]] static PixelMoments At(const Grid& grid, int column, int row) noexcept {
    if (column < 0 || row < 0 || column >= grid.columns() || row >= grid.rows()) return {};
    return grid.block(column, row);
  }
  [[nodiscard]] static std::size_t Side(int r) noexcept { return static_cast<std::size_t>(r); }

  /// @param i The first of the windows; its own block is the (i + 1)th of the row.
  void MergeLanes(int i, float step_px) noexcept;

  std::array<Columns, 3> blocks_;  ///< The row above, the windows' own, the one below.
  Columns sums_;
  Row fewest_;
  std::array<Row, 3> bends_;
};

}  // namespace disflow
