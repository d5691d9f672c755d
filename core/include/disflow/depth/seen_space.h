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
template <int kMaxViews>
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
    for (int row = 0; row < kCells; ++row) {
      for (int column = 0; column < kCells; ++column)
        view.nearest_mm[Index(column, row)] = Nearest(depth, view, column, row);
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
  static constexpr int kCells = 48;
  static constexpr float kNewSide_rad = 0.35F;
  static constexpr float kMarginPerMetre = 0.01F;
  static constexpr float kWidening = 0.3F;  ///< To each side, share of the object's size.
  static constexpr int kBorder_px = 2;      ///< Pixels around a cell that count as part of it.

  struct View {
    PoseCameraFromObject T_co;
    PinholeCamera camera;
    PixelBox box;
    int cell_px = 1;
    /// 0: unknown.
    std::array<std::uint16_t, static_cast<std::size_t>(kCells* kCells)> nearest_mm;
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

  [[nodiscard]] static std::uint16_t Nearest(const DepthReader& depth, const View& view, int column,
                                             int row) noexcept {
    const int u = view.box.u_min + column * view.cell_px;
    const int v = view.box.v_min + row * view.cell_px;
    if (u >= view.box.u_max || v >= view.box.v_max) return 0;
    const PixelBox cell{std::max(u - kBorder_px, 0), std::max(v - kBorder_px, 0),
                        std::min(u + view.cell_px + kBorder_px, depth.width_px()),
                        std::min(v + view.cell_px + kBorder_px, depth.height_px())};
    float nearest_m = 1e9F;
    int valid = 0;
    for (int y = cell.v_min; y < cell.v_max; ++y) {
      for (int x = cell.u_min; x < cell.u_max; ++x) {
        const float depth_m = depth.At(x, y);
        if (depth_m <= 0.0F) continue;
        ++valid;
        nearest_m = std::min(nearest_m, depth_m);
      }
    }
    // Where a sensor loses many pixels something may have been in the way.
    if (4 * valid < 3 * cell.width() * cell.height()) return 0;
    return static_cast<std::uint16_t>(std::min(1000.0F * nearest_m, 65535.0F));
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
    const float seen_m = 1e-3F * static_cast<float>(view.nearest_mm[Index(column, row)]);
    return x_c.z() + margin_m + kMarginPerMetre * x_c.z() < seen_m;
  }

  FixedVector<View, kMaxViews> views_;
  int next_ = 0;
};

}  // namespace disflow
