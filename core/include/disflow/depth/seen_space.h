// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "disflow/depth/depth_reader.h"
#include "disflow/depth/nearest_columns.h"
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
           const PixelBox& object) noexcept {
    if (object.empty() || !IsNewSide(T_oc)) return;
    if (!views_.full()) (void)views_.push_back({});
    View& view = views_[next_];
    next_ = (next_ + 1) % kMaxViews;
    view.T_co = T_oc.Inverse();
    view.camera = camera;
    view.box = Widened(object, depth);
    view.cell_px = (std::max(view.box.width(), view.box.height()) + kCells - 1) / kCells;
    view.floor_m = NearestIn(depth, view.box).depth_m;
    view.steps.fill(0);
    // As many cells at once as are scanned together; of cells that are too large for that one.
    const int fitting = (NearestColumns::kMaxWidth_px - 2 * kBorder_px) / view.cell_px;
    const int columns = std::max(fitting, 1);
    for (int row = 0; row < kCells; ++row) {
      for (int column = 0; column < kCells; column += columns)
        FillCells(depth, row, column, std::min(column + columns, kCells), view);
    }
  }

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

  [[nodiscard]] static PixelBox Widened(const PixelBox& box, const DepthReader& depth) noexcept {
    const int margin =
        static_cast<int>(kWidening * static_cast<float>(std::max(box.width(), box.height())));
    return {std::max(box.u_min - margin, 0), std::max(box.v_min - margin, 0),
            std::min(box.u_max + margin, depth.width_px()),
            std::min(box.v_max + margin, depth.height_px())};
  }

  [[nodiscard]] static NearestDepth NearestIn(const DepthReader& depth,
                                              const PixelBox& box) noexcept {
    NearestDepth nearest;
    NearestColumns columns;
    for (int u = box.u_min; u < box.u_max; u += NearestColumns::kMaxWidth_px) {
      const PixelBox part{u, box.v_min, std::min(u + NearestColumns::kMaxWidth_px, box.u_max),
                          box.v_max};
      columns.Scan(depth, part);
      nearest.Add(columns.Within(0, part.width()));
    }
    return nearest;
  }

  /// The pixels of the cells [column, column_end) of a row of cells, with those around them.
  [[nodiscard]] static PixelBox CellBox(const View& view, int row, int column,
                                        int column_end) noexcept {
    const PixelBox cells{view.box.u_min + column * view.cell_px - kBorder_px,
                         view.box.v_min + row * view.cell_px - kBorder_px,
                         view.box.u_min + column_end * view.cell_px + kBorder_px,
                         view.box.v_min + (row + 1) * view.cell_px + kBorder_px};
    return Common(cells, view.box);
  }

  static void FillCells(const DepthReader& depth, int row, int column, int column_end,
                        View& view) noexcept {
    if (view.box.v_min + row * view.cell_px >= view.box.v_max) return;
    const PixelBox all = CellBox(view, row, column, column_end);
    const bool together = all.width() <= NearestColumns::kMaxWidth_px;
    NearestColumns columns;
    if (together) columns.Scan(depth, all);
    for (int c = column; c < column_end; ++c) {
      if (view.box.u_min + c * view.cell_px >= view.box.u_max) return;
      const PixelBox cell = CellBox(view, row, c, c + 1);
      const NearestDepth nearest =
          together ? columns.Within(cell.u_min - all.u_min, cell.u_max - all.u_min)
                   : NearestIn(depth, cell);
      // Where a sensor loses many pixels something may have been in the way.
      if (4 * nearest.valid < 3 * cell.width() * cell.height()) continue;
      const float steps = (nearest.depth_m - view.floor_m) / kStep_m;
      view.steps[Index(c, row)] = static_cast<std::uint8_t>(1.0F + std::min(steps, 254.0F));
    }
  }

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
