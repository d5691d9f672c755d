// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "disflow/depth/outline.h"
#include "disflow/flow/model_agreement.h"

namespace disflow {

/// What a model covers of an image, in cells, so coarse that its samples leave no holes. Cells far
/// apart share a bit, so that the memory is fixed: in a very large image of an object some narrow
/// parts count as wide.
class ModelSilhouette {
 public:
  /// @param points_apart_m Distance of neighbouring samples of the model.
  /// @param depth_m Of the model.
  ModelSilhouette(const PinholeCamera& camera, float points_apart_m, float depth_m) noexcept
      : cell_px_(std::max(0.5F * kMatchingReachPx, points_apart_m * camera.fx_px / depth_m)),
        narrow_cells_(static_cast<int>(kMatchingReachPx / cell_px_) + 1) {}

  void Add(const Vec2& px) noexcept { cells_[Wrapped(Cell(px.y()))] |= Bit(Cell(px.x())); }

  /// Whether the model is so narrow there that a camera which matches windows of pixels may see
  /// what is behind it instead: less than half a window.
  [[nodiscard]] bool IsNarrowAt(const Vec2& px) const noexcept {
    return ExtentAt(px, 1, 0) <= narrow_cells_ || ExtentAt(px, 0, 1) <= narrow_cells_ ||
           ExtentAt(px, 1, 1) <= narrow_cells_ || ExtentAt(px, 1, -1) <= narrow_cells_;
  }

 private:
  static constexpr int kCells = 64;  ///< A power of two.

  [[nodiscard]] static std::size_t Wrapped(int cell) noexcept {
    return static_cast<std::size_t>(cell & (kCells - 1));
  }
  [[nodiscard]] static std::uint64_t Bit(int cell) noexcept {
    return std::uint64_t{1} << Wrapped(cell);
  }
  [[nodiscard]] int Cell(float px) const noexcept {
    return static_cast<int>(std::floor(px / cell_px_));
  }
  [[nodiscard]] bool Covers(int column, int row) const noexcept {
    return (cells_[Wrapped(row)] & Bit(column)) != 0U;
  }

  /// Covered cells in a row through a place; one more than is narrow is enough.
  [[nodiscard]] int ExtentAt(const Vec2& px, int columns, int rows) const noexcept {
    int extent = 1;
    for (const int way : {-1, 1}) {
      for (int i = 1; i <= narrow_cells_; ++i, ++extent) {
        if (!Covers(Cell(px.x()) + way * i * columns, Cell(px.y()) + way * i * rows)) break;
      }
    }
    return extent;
  }

  float cell_px_;
  int narrow_cells_;  ///< That a strip of half a window's width touches at most.
  std::array<std::uint64_t, static_cast<std::size_t>(kCells)> cells_{};
};

/// Share of the decided points that contradict a pose without those where the model is too narrow
/// for the camera: a sheet seen from its edge is not there for a camera that matches windows.
/// @param agreement CompareWithImage() for the same arguments.
/// @param harmless A conflict up to there is given back as it is: most frames have none.
template <class Field>
[[nodiscard]] float ResolvedConflict(const Field& field, const PoseObjectFromCamera& T_oc,
                                     const PinholeCamera& camera, const DepthReader& depth,
                                     const ModelAgreement& agreement,
                                     float harmless = 0.0F) noexcept {
  if (agreement.conflict() <= harmless) return agreement.conflict();
  // Samples are merged up to there.
  const float points_apart_m = field.config().merge_radius_m;
  const PoseCameraFromObject T_co = T_oc.Inverse();
  const Vec3 center_o = 0.5F * (field.bounds_min_m() + field.bounds_max_m());
  const float depth_m = std::max((T_co * center_o).z(), points_apart_m);
  ModelSilhouette silhouette(camera, points_apart_m, depth_m);
  field.store().ForEach([&](auto, const auto& cluster) {
    for (int i = 0; i < cluster.samples.size(); ++i) {
      const Vec3 x_c = T_co * cluster.samples.position_m(i);
      if (x_c.z() > 0.5F * depth_m) silhouette.Add(camera.Project(x_c));
    }
  });
  ModelAgreement resolved = agreement;
  (void)CompareWithImage(field, T_oc, camera, depth, [&](auto handle, bool seen) {
    const Vec3 x_c = T_co * field.store()[handle].centroid_m;
    if (!seen && silhouette.IsNarrowAt(camera.Project(x_c))) --resolved.contradicted;
  });
  return resolved.conflict();
}

}  // namespace disflow
