// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>

#include "disflow/depth/nearest_columns.h"
#include "disflow/depth/seen_space.h"

/// @file
/// How a view is remembered: definitions of members of SeenSpace. Needed by those only who add
/// views.

namespace disflow {

/// The nearest depth of a part of an image, and how much of it has one.
[[nodiscard]] inline NearestDepth NearestIn(const DepthReader& depth,
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

/// The bounds of an object with a share of its size to each side, as far as there is an image.
[[nodiscard]] inline PixelBox Widened(const PixelBox& box, float share,
                                      const DepthReader& depth) noexcept {
  const int margin =
      static_cast<int>(share * static_cast<float>(std::max(box.width(), box.height())));
  return {std::max(box.u_min - margin, 0), std::max(box.v_min - margin, 0),
          std::min(box.u_max + margin, depth.width_px()),
          std::min(box.v_max + margin, depth.height_px())};
}

template <int kMaxViews, int kCells>
void SeenSpace<kMaxViews, kCells>::Add(const DepthReader& depth, const PinholeCamera& camera,
                                       const PoseObjectFromCamera& T_oc,
                                       const PixelBox& object) noexcept {
  if (object.empty() || !IsNewSide(T_oc)) return;
  if (!views_.full()) (void)views_.push_back({});
  View& view = views_[next_];
  next_ = (next_ + 1) % kMaxViews;
  view.T_co = T_oc.Inverse();
  view.camera = camera;
  view.box = Widened(object, kWidening, depth);
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

template <int kMaxViews, int kCells>
PixelBox SeenSpace<kMaxViews, kCells>::CellBox(const View& view, int row, int column,
                                               int column_end) noexcept {
  const PixelBox cells{view.box.u_min + column * view.cell_px - kBorder_px,
                       view.box.v_min + row * view.cell_px - kBorder_px,
                       view.box.u_min + column_end * view.cell_px + kBorder_px,
                       view.box.v_min + (row + 1) * view.cell_px + kBorder_px};
  return Common(cells, view.box);
}

template <int kMaxViews, int kCells>
void SeenSpace<kMaxViews, kCells>::FillCells(const DepthReader& depth, int row, int column,
                                             int column_end, View& view) noexcept {
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

}  // namespace disflow
