// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "disflow/depth/depth_reader.h"
#include "disflow/depth/pixel_row.h"

namespace disflow {

/// The nearest depth of some pixels.
struct NearestDepth {
  static constexpr float kNone_m = 1e9F;

  float depth_m = kNone_m;
  int valid = 0;  ///< Pixels with depth.

  void Add(const NearestDepth& other) noexcept {
    depth_m = std::min(depth_m, other.depth_m);
    valid += other.valid;
  }
};

/// The nearest depth of each of up to kMaxWidth_px columns, over some rows of an image.
class NearestColumns {
 public:
  static constexpr int kMaxWidth_px = 128;

  /// @param box At most kMaxWidth_px wide.
  void Scan(const DepthReader& depth, const PixelBox& box) noexcept {
    const auto width = static_cast<std::size_t>(box.width());
    std::fill_n(nearest_m_.begin(), width, NearestDepth::kNone_m);
    std::fill_n(valid_.begin(), width, 0);
    std::array<float, static_cast<std::size_t>(kMaxWidth_px)> row_m;
    for (int v = box.v_min; v < box.v_max; ++v) {
      depth.ReadRow(v, box.u_min, box.u_max, row_m.data());
      // Whole rows at a time, for vector instructions.
      for (std::size_t i = 0; i < width; ++i) {
        const int here = int{row_m[i] > 0.0F};
        const float depth_m = here != 0 ? row_m[i] : NearestDepth::kNone_m;
        nearest_m_[i] = depth_m < nearest_m_[i] ? depth_m : nearest_m_[i];
        valid_[i] += here;
      }
    }
  }

  /// Of the columns [begin, end), counted from the box's first.
  [[nodiscard]] NearestDepth Within(int begin, int end) const noexcept {
    NearestDepth nearest;
    for (int i = begin; i < end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      nearest.Add({nearest_m_[k], valid_[k]});
    }
    return nearest;
  }

 private:
  std::array<float, static_cast<std::size_t>(kMaxWidth_px)> nearest_m_;
  std::array<std::int32_t, static_cast<std::size_t>(kMaxWidth_px)> valid_;
};

}  // namespace disflow
