// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow/field/edge_map.h"

namespace disflow {

/// Model edges in slices along the axis along which they reach farthest, for many searches in a map
/// that does not change meanwhile. Build() it before first use.
template <int kMaxEdges>
class EdgeIndex {
 public:
  /// @param edges At most kMaxEdges; must neither change nor move while this is used.
  void Build(std::span<const ModelEdge> edges) noexcept {
    edges_ = edges;
    ChooseAxis();
    // A counting sort: how many lie in each slice, where each slice begins, who is there.
    start_.fill(0);
    for (const ModelEdge& edge : edges) ++start_[Slice(edge.position_m[axis_]) + 2];
    for (std::size_t i = 2; i < start_.size(); ++i)
      start_[i] = static_cast<std::uint16_t>(start_[i] + start_[i - 1]);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Vec3& position_m = edges[i].position_m;
      const std::uint16_t place = start_[Slice(position_m[axis_]) + 1]++;
      SetPlace(place, position_m);
      number_[place] = static_cast<std::uint16_t>(i);
    }
    const Vec3 nowhere_m = Vec3::Constant(kNowhere_m);
    for (std::size_t i = edges.size(); i < edges.size() + kGroup; ++i) SetPlace(i, nowhere_m);
  }

  /// As FindNearestEdge().
  /// @return Null if there is none.
  [[nodiscard]] const ModelEdge* FindNearest(const EdgePoint& point,
                                             float radius_m) const noexcept {
    const ModelEdge* nearest = nullptr;
    float nearest_squared = radius_m * radius_m;
    const Vec3 at_m = point.position_m;
    const std::size_t begin = start_[Slice(at_m[axis_] - radius_m)];
    const std::size_t end = start_[Slice(at_m[axis_] + radius_m) + 1];
    for (std::size_t i = begin; i < end; i += kGroup) {
      std::array<float, kGroup> squared_m2;
      int any = 0;
      // Most are too far off, which vector instructions see.
      for (std::size_t k = 0; k < kGroup; ++k) {
        const float x = x_m_[i + k] - at_m.x();
        const float y = y_m_[i + k] - at_m.y();
        const float z = z_m_[i + k] - at_m.z();
        squared_m2[k] = x * x + (y * y + z * z);
        any |= int{squared_m2[k] < nearest_squared};
      }
      if (any == 0) continue;
      for (std::size_t k = 0; k < kGroup; ++k) {
        if (!(squared_m2[k] < nearest_squared)) continue;
        const ModelEdge& edge = edges_[number_[i + k]];
        if (!IsSeenAs(edge, point)) continue;
        nearest_squared = squared_m2[k];
        nearest = &edge;
      }
    }
    return nearest;
  }

 private:
  static constexpr std::size_t kSlices = 64;
  static constexpr std::size_t kGroup = 8;
  static constexpr float kNowhere_m = 1e18F;  ///< Its square is still a number.
  using Coordinates = std::array<float, static_cast<std::size_t>(kMaxEdges) + kGroup>;

  void ChooseAxis() noexcept {
    Vec3 low_m = Vec3::Constant(kNowhere_m);
    Vec3 high_m = -low_m;
    for (const ModelEdge& edge : edges_) {
      low_m = low_m.cwiseMin(edge.position_m);
      high_m = high_m.cwiseMax(edge.position_m);
    }
    constexpr float kShortest_m = 1e-3F;
    const Vec3 extent_m = high_m - low_m;
    axis_ = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (extent_m[axis] > extent_m[axis_]) axis_ = axis;
    }
    first_m_ = low_m[axis_];
    slices_per_m_ = static_cast<float>(kSlices) / std::max(extent_m[axis_], kShortest_m);
  }

  /// Grows with the coordinate, wherever that is.
  [[nodiscard]] std::size_t Slice(float coordinate_m) const noexcept {
    const float slice = (coordinate_m - first_m_) * slices_per_m_;
    const float above = slice > 0.0F ? slice : 0.0F;
    constexpr auto kLast = static_cast<float>(kSlices - 1);
    return static_cast<std::size_t>(static_cast<int>(above < kLast ? above : kLast));
  }

  void SetPlace(std::size_t i, const Vec3& position_m) noexcept {
    x_m_[i] = position_m.x();
    y_m_[i] = position_m.y();
    z_m_[i] = position_m.z();
  }

  std::span<const ModelEdge> edges_;
  // Slice by slice.
  Coordinates x_m_;
  Coordinates y_m_;
  Coordinates z_m_;
  std::array<std::uint16_t, static_cast<std::size_t>(kMaxEdges) + kGroup> number_;
  std::array<std::uint16_t, kSlices + 2> start_;  ///< Of each slice; one more is the end.
  int axis_ = 0;
  float first_m_ = 0.0F;
  float slices_per_m_ = 0.0F;
};

}  // namespace disflow
