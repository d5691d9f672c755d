// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/depth/depth_reader.h"

namespace disflow::apps {

/// A depth image for people to look at, smaller than the camera's, with the object's pixels marked.
class DepthPicture {
 public:
  /// Width and height at most.
  static constexpr int kLongestSide_px = 240;

  DepthPicture()
      : depth_mm_(static_cast<std::size_t>(kLongestSide_px) * kLongestSide_px),
        object_(depth_mm_.size()) {}

  /// Takes every n-th pixel. Does not allocate.
  /// @param mask Has Test(u, v) and the frame's size: pixels taken for the object.
  template <class Mask>
  void Take(const DepthFrame& frame, const Mask& mask) noexcept {
    const int longest_px = std::max(frame.depth.width_px, frame.depth.height_px);
    step_px_ = std::max(1, (longest_px + kLongestSide_px - 1) / kLongestSide_px);
    width_px_ = frame.depth.width_px / step_px_;
    height_px_ = frame.depth.height_px / step_px_;
    const bool has_mask =
        mask.width_px() == frame.depth.width_px && mask.height_px() == frame.depth.height_px;
    const DepthReader depth(frame.depth, 0.0F, kFarthest_m);
    std::size_t i = 0;
    for (int y = 0; y < height_px_; ++y) {
      for (int x = 0; x < width_px_; ++x, ++i) {
        const int u = x * step_px_;
        const int v = y * step_px_;
        depth_mm_[i] = static_cast<std::uint16_t>(std::lround(depth.At(u, v) * 1000.0F));
        object_[i] = static_cast<std::uint8_t>(has_mask && mask.Test(u, v));
      }
    }
  }

  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }
  /// Camera pixels per pixel of the picture.
  [[nodiscard]] int step_px() const noexcept { return step_px_; }
  /// Row-major, width x height values are valid; 0 = no data.
  [[nodiscard]] const std::vector<std::uint16_t>& depth_mm() const noexcept { return depth_mm_; }
  /// Row-major; 1 = taken for the object.
  [[nodiscard]] const std::vector<std::uint8_t>& object() const noexcept { return object_; }

 private:
  static constexpr float kFarthest_m = 65.0F;  ///< That 16 bits can tell.

  std::vector<std::uint16_t> depth_mm_;
  std::vector<std::uint8_t> object_;
  int width_px_ = 0;
  int height_px_ = 0;
  int step_px_ = 1;
};

}  // namespace disflow::apps
