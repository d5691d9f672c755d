// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "disflow/depth/depth_frame.h"
#include "disflow/depth/pixel_mask.h"

namespace disflow::testing {

/// A depth image to draw flat things into, and a mask.
class DepthScene {
 public:
  static constexpr int kWidth_px = 160;
  static constexpr int kHeight_px = 120;
  static constexpr float kFocal_px = 150.0F;

  /// A wall that faces the camera.
  explicit DepthScene(float wall_m = 2.0F)
      : depth_m_(kPixels, wall_m), mask_(kPixels, std::uint8_t{0}) {}

  /// A rectangle that faces the camera. Draws over what is there.
  DepthScene& Rectangle(const PixelBox& box, float depth_m) {
    return Draw(box, [depth_m](int, int) { return depth_m; });
  }
  /// A table seen from above, from 4 m at the top of the image to 0.9 m at its foot, where that is
  /// nearer than what is there.
  DepthScene& Table() {
    constexpr float kOffset_per_m = 0.25F;
    constexpr float kSlope_per_m = 0.007F;
    for (int v = 0; v < kHeight_px; ++v) {
      const float table_m = 1.0F / (kOffset_per_m + kSlope_per_m * static_cast<float>(v));
      for (int u = 0; u < kWidth_px; ++u) {
        float& depth_m = depth_m_[Index(u, v)];
        depth_m = std::min(depth_m, table_m);
      }
    }
    return *this;
  }
  /// depth_m(u, v) for every pixel of the box.
  template <class Depth>
  DepthScene& Draw(const PixelBox& box, Depth&& depth_m) {
    for (int v = box.v_min; v < box.v_max; ++v) {
      for (int u = box.u_min; u < box.u_max; ++u) depth_m_[Index(u, v)] = depth_m(u, v);
    }
    return *this;
  }
  DepthScene& Mask(const PixelBox& box) {
    has_mask_ = true;
    for (int v = box.v_min; v < box.v_max; ++v) {
      for (int u = box.u_min; u < box.u_max; ++u) mask_[Index(u, v)] = 255;
    }
    return *this;
  }

  /// Its views stay valid as long as this object.
  [[nodiscard]] DepthFrame frame() const {
    DepthFrame frame;
    frame.depth = {depth_m_.data(),       kWidth_px, kHeight_px, 4 * kWidth_px,
                   DepthFormat::kFloat32, 0.001F};
    frame.camera = camera();
    frame.stamp_ns = 1;
    if (has_mask_) frame.mask = {mask_.data(), kWidth_px, kHeight_px, kWidth_px};
    return frame;
  }
  [[nodiscard]] float At(int u, int v) const { return depth_m_[Index(u, v)]; }
  [[nodiscard]] static PinholeCamera camera() {
    return {kFocal_px, kFocal_px, 0.5F * kWidth_px, 0.5F * kHeight_px};
  }
  [[nodiscard]] static PixelBox image() { return {0, 0, kWidth_px, kHeight_px}; }

 private:
  static constexpr std::size_t kPixels = kWidth_px * kHeight_px;
  [[nodiscard]] static std::size_t Index(int u, int v) {
    return static_cast<std::size_t>(v * kWidth_px + u);
  }

  std::vector<float> depth_m_;
  std::vector<std::uint8_t> mask_;
  bool has_mask_ = false;
};

[[nodiscard]] inline bool Covers(const PixelBox& box, int u, int v) {
  return u >= box.u_min && u < box.u_max && v >= box.v_min && v < box.v_max;
}

}  // namespace disflow::testing
