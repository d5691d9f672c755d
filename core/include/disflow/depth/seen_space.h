// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "disflow/depth/depth_reader.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/geometry/pinhole_camera.h"
#include "disflow/geometry/transform.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// Remembers through which space around the object the camera has looked. A rigid object does not
/// grow: what appears later where an earlier view saw the background does not belong to it, however
/// long it moves along. This tells apart a hand that touches the object from surface that comes
/// into view by turning.
///
/// A few views are kept, each a coarse depth image of the object's surroundings in which a cell
/// holds the nearest depth in it, so that doubt speaks for the object.
/// Add() is defined in seen_space_impl.h.
/// @tparam kCells Along either side of a view.
template <int kMaxViews, int kCells>
class SeenSpace {
 public:
  void Start() noexcept {
    views_.clear();
    next_ = 0;
  }
  [[nodiscard]] int views() const noexcept { return views_.size(); }

  /// Remembers a frame if the object is seen from a new side.
  /// @param object Bounds of the object in the image.
  /// @param depth Must not be cut off at the range where the object ends: background counts.
  void Add(const DepthReader& depth, const PinholeCamera& camera, const PoseObjectFromCamera& T_oc,
           const PixelBox& object) noexcept;

  /// Whether an earlier view looked through a point.
  /// @param x_o Object frame.
  /// @param margin_m How far in front of what was seen the point has to be, at least.
  [[nodiscard]] bool IsFree(const Vec3& x_o, float margin_m) const noexcept {
    return std::any_of(views_.begin(), views_.end(),
                       [&](const View& view) { return LooksThrough(view, x_o, margin_m); });
  }

 private:
  static constexpr float kNewSide_rad = 0.35F;
  static constexpr float kMarginPerMetre = 0.01F;
  static constexpr float kStep_m =
      0.008F;  ///< Background is known as far as 2 m behind the object.
  static constexpr float kWidening = 0.3F;  ///< To each side, share of the object's size.
  static constexpr int kBorder_px = 2;      ///< Pixels around a cell that count as part of it.

  struct View {
    PoseCameraFromObject T_co;
    PinholeCamera camera;
    PixelBox box;
    int cell_px = 1;
    float floor_m = 0.0F;  ///< Nothing in the view is nearer.
    /// Nearest depth of a cell above the floor, in kStep_m, rounded down, plus 1; 0: unknown.
    std::array<std::uint8_t, static_cast<std::size_t>(kCells* kCells)> steps;
  };

  [[nodiscard]] static std::size_t Index(int column, int row) noexcept {
    return static_cast<std::size_t>(row * kCells + column);
  }

  [[nodiscard]] bool IsNewSide(const PoseObjectFromCamera& T_oc) const noexcept {
    return std::none_of(views_.begin(), views_.end(), [&](const View& view) {
      return LogSo3(Mat3(T_oc.rotation() * view.T_co.rotation())).norm() < kNewSide_rad;
    });
  }

  static void FillCells(const DepthReader& depth, int row, int column, int column_end,
                        View& view) noexcept;
  /// The pixels of the cells [column, column_end) of a row of cells, with those around them.
  [[nodiscard]] static PixelBox CellBox(const View& view, int row, int column,
                                        int column_end) noexcept;

  [[nodiscard]] static bool LooksThrough(const View& view, const Vec3& x_o,
                                         float margin_m) noexcept {
    const Vec3 x_c = view.T_co * x_o;
    if (!(x_c.z() > 0.0F)) return false;
    const Vec2 px = view.camera.Project(x_c);
    const auto inside = [](float at_px, int min_px, int max_px) {
      return at_px >= static_cast<float>(min_px) && at_px < static_cast<float>(max_px);
    };
    if (!inside(px.x(), view.box.u_min, view.box.u_max) ||
        !inside(px.y(), view.box.v_min, view.box.v_max)) {
      return false;
    }
    const int column = (static_cast<int>(px.x()) - view.box.u_min) / view.cell_px;
    const int row = (static_cast<int>(px.y()) - view.box.v_min) / view.cell_px;
    const int steps = view.steps[Index(column, row)];
    if (steps == 0) return false;
    const float seen_m = view.floor_m + kStep_m * static_cast<float>(steps - 1);
    return x_c.z() + margin_m + kMarginPerMetre * x_c.z() < seen_m;
  }

  FixedVector<View, kMaxViews> views_;
  int next_ = 0;
};

}  // namespace disflow
