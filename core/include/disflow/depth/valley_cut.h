// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "disflow/depth/depth_reader.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/geometry/pinhole_camera.h"

namespace disflow {

/// Cuts surfaces where they fold towards the camera: there one thing stands on another or leans
/// against it, while the faces of one thing mostly meet at ridges.
///
/// In inverse depth w = 1/z a plane is affine in the pixel, so the second difference
/// w(u - s) - 2 w(u) + w(u + s) is 0 on it, negative on ridges, and positive in valleys. It is
/// compared with what the sensor's noise makes of it, which third differences tell apart from
/// curvature. Works on means of 2 x 2 pixels, of whose rows it keeps as many as a row is compared
/// across: whoever asks from top to bottom has each row of the image read once.
///
/// Start() and operator() are defined in valley_cut_impl.h.
template <int kMaxWidth>
class ValleyCut {
 public:
  /// Measures the noise and chooses the stride. Once per image.
  /// @param box Part of the image that the rows will be of.
  /// @param distance_m Of the object; 0 = unknown, the median of the box is taken.
  void Start(const DepthReader& depth, const PinholeCamera& camera, const PixelBox& box,
             float distance_m) noexcept;

  /// Surfaces are not cut.
  void Clear() noexcept { stride_ = 0; }
  [[nodiscard]] bool empty() const noexcept { return stride_ == 0; }
  /// How far beside a fold a pixel may still count as lying in it.
  [[nodiscard]] int reach_px() const noexcept { return kCellPx * stride_; }

  /// Sets to 0 the depths of the pixels [u_begin, u_end) of row v that lie in a valley. Of the
  /// image and box that were given to Start(), in any order.
  void operator()(const DepthReader& depth, int v, int u_begin, int u_end, float* depth_m) noexcept;

 private:
  static constexpr int kCellPx = 2;
  static constexpr int kLeastStride = 2;
  static constexpr int kMostStride = 8;
  static constexpr int kMaxCells = (kMaxWidth + 1) / kCellPx;
  /// From the highest to the lowest that a row is compared with.
  static constexpr int kRows = 2 * kMostStride + 1;
  static constexpr int kNoRow = std::numeric_limits<int>::min();
  /// From the fold to either side: inner corners of things that touch are rounded by less.
  static constexpr float kReach_m = 0.010F;
  /// Between the slopes on either side, m/m: 31 degrees if seen from straight ahead.
  static constexpr float kFold = 0.6F;
  static constexpr float kSigmas = 4.0F;
  /// Farther apart pixels of real sensors hardly correlate.
  static constexpr int kNoiseStepPx = 4;
  static constexpr int kMaxLines = 256;
  /// Added to a cell without depth, which makes its inverse depth negative.
  static constexpr float kNone = -1e6F;

  using Line = std::array<float, 4>;
  /// Inverse depths, 1/m, of the columns and of kMostStride more to either side.
  using Cells = std::array<float, static_cast<std::size_t>(kMaxCells + 2 * kMostStride)>;

  template <class Value>
  [[nodiscard]] static float Median(const DepthReader& depth, const PixelBox& box,
                                    Value&& value) noexcept;
  [[nodiscard]] static bool ReadLine(const DepthReader& depth, int u, int v, int du, int dv,
                                     Line& line) noexcept;
  [[nodiscard]] static float CellAt(const DepthReader& depth, int u, int v) noexcept;

  void Forget(int begin, int end) noexcept;
  void FlagRow(const DepthReader& depth, int row) noexcept;
  void FlagFolds(int stride, const Cells& above_per_m, const Cells& here_per_m,
                 const Cells& below_per_m) noexcept;
  [[nodiscard]] const Cells& CellsOf(const DepthReader& depth, int row) noexcept;
  void ReadCells(const DepthReader& depth, int row, Cells& cells) noexcept;
  template <class SomeCells>
  [[nodiscard]] static auto* At(SomeCells& cells, int i) noexcept {
    return cells.data() + kMostStride + i;
  }

  int begin_ = 0;  ///< Columns [begin, end) that are held, in cells.
  int end_ = 0;
  int row_ = kNoRow;                ///< Whose valleys are flagged.
  int stride_ = 0;                  ///< In cells; 0 = surfaces are not cut.
  float least_per_m_ = 0.0F;        ///< Second difference that noise does not reach.
  float least_fold_ = 0.0F;         ///< That of the flattest valley, share of w and cell of stride.
  std::array<int, kRows> held_;     ///< Which row lies where.
  std::array<Cells, kRows> cells_;  ///< Row r in place r modulo kRows.
  std::array<float, static_cast<std::size_t>(kMaxWidth + 1)> pixels_m_;
  std::array<std::uint8_t, static_cast<std::size_t>(kMaxCells)> valley_;
};

}  // namespace disflow
