// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstring>
#include <limits>

#include "disflow/depth/depth_frame.h"

namespace disflow {

/// Reads depth in metres from a row of either format; what is not usable reads as 0.
class DepthReader {
 public:
  DepthReader(const DepthView& view, float min_range_m, float max_range_m) noexcept
      : view_(view), min_m_(std::max(min_range_m, kLeast_m)), max_m_(max_range_m) {}

  [[nodiscard]] float At(int u, int v) const noexcept {
    const std::byte* pixel =
        view_.row(v) + static_cast<std::ptrdiff_t>(u) * view_.bytes_per_pixel();
    float depth_m = 0.0F;
    if (view_.format == DepthFormat::kUint16) {
      std::uint16_t raw = 0;
      std::memcpy(&raw, pixel, sizeof raw);
      depth_m = static_cast<float>(raw) * view_.unit_m;
    } else {
      std::memcpy(&depth_m, pixel, sizeof depth_m);
    }
    return InRangeOrZero(depth_m, min_m_, max_m_);
  }

  /// As At(), but 0 outside of the image.
  [[nodiscard]] float AtOrZero(int u, int v) const noexcept {
    return u < 0 || v < 0 || u >= view_.width_px || v >= view_.height_px ? 0.0F : At(u, v);
  }

  /// At() of the pixels [u_begin, u_end) of row v, into depth_m[0], depth_m[1], ...
  void ReadRow(int v, int u_begin, int u_end, float* depth_m) const noexcept {
    const int count = u_end - u_begin;
    const std::byte* pixels =
        view_.row(v) + static_cast<std::ptrdiff_t>(u_begin) * view_.bytes_per_pixel();
    // Copies, which the row that is written cannot overlap.
    const float min_m = min_m_;
    const float max_m = max_m_;
    if (view_.format == DepthFormat::kUint16) {
      const float unit_m = view_.unit_m;
      for (int i = 0; i < count; ++i) {
        std::uint16_t raw = 0;
        std::memcpy(&raw, pixels + 2 * i, sizeof raw);
        depth_m[i] = InRangeOrZero(static_cast<float>(raw) * unit_m, min_m, max_m);
      }
    } else {
      for (int i = 0; i < count; ++i) {
        float value_m = 0.0F;
        std::memcpy(&value_m, pixels + 4 * i, sizeof value_m);
        depth_m[i] = InRangeOrZero(value_m, min_m, max_m);
      }
    }
  }

  [[nodiscard]] int width_px() const noexcept { return view_.width_px; }
  [[nodiscard]] int height_px() const noexcept { return view_.height_px; }

 private:
  /// What is not above 0 is no depth, whatever the range.
  static constexpr float kLeast_m = std::numeric_limits<float>::min();

  /// NaN fails all comparisons. Branch-free, so that compilers use vector instructions on rows.
  [[nodiscard]] static float InRangeOrZero(float depth_m, float min_m, float max_m) noexcept {
    const int usable = int{depth_m >= min_m} & int{depth_m <= max_m};
    return usable != 0 ? depth_m : 0.0F;
  }

  DepthView view_;
  float min_m_;
  float max_m_;
};

}  // namespace disflow
