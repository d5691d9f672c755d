// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "disflow/depth/depth_frame.h"

namespace disflow::test {

/// A tumbling box in front of a wall, ray-cast analytically: true poses, no files, the same on
/// every machine.
class BoxScene {
 public:
  static constexpr int kWidth = 320;
  static constexpr int kHeight = 180;

  struct Image {
    std::vector<float> depth_m;
    std::vector<std::uint8_t> mask;
    StampNs stamp_ns = 0;
    PoseCameraFromObject T_co;

    [[nodiscard]] DepthFrame Frame() const {
      DepthFrame frame;
      frame.depth = {depth_m.data(), kWidth, kHeight, kWidth * 4, DepthFormat::kFloat32, 0.001F};
      frame.camera = Camera();
      frame.mask = {mask.data(), kWidth, kHeight, kWidth};
      frame.stamp_ns = stamp_ns;
      return frame;
    }
  };

  [[nodiscard]] static PinholeCamera Camera() { return {307.0F, 307.0F, 160.0F, 90.0F}; }
  [[nodiscard]] static Vec3 HalfSize() { return {0.08F, 0.035F, 0.10F}; }

  /// @param noise_per_m Standard deviation of the inverse depth.
  [[nodiscard]] static Image Render(int index, float noise_per_m) {
    Image image;
    image.stamp_ns = 1'000'000'000 + static_cast<StampNs>(index) * 33'333'333;
    image.T_co = PoseAt(static_cast<float>(index) / 30.0F);
    image.depth_m.resize(static_cast<std::size_t>(kWidth) * kHeight);
    image.mask.resize(image.depth_m.size());
    std::uint32_t random = 12345U + static_cast<std::uint32_t>(index) * 977U;
    const auto T_oc = image.T_co.Inverse();
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const auto i = static_cast<std::size_t>(v * kWidth + u);
        const Vec3 ray = Camera().Ray(static_cast<float>(u), static_cast<float>(v));
        float depth_m = Hit(T_oc.translation(), T_oc.rotation() * ray);
        image.mask[i] = depth_m > 0.0F ? 255 : 0;
        if (depth_m <= 0.0F) depth_m = 1.4F + 0.2F * ray.x();
        float sum = 0.0F;  // of uniform numbers: close to a normal distribution
        for (int k = 0; k < 4; ++k) {
          random = random * 1664525U + 1013904223U;
          sum += static_cast<float>(random >> 8) / 16777216.0F - 0.5F;
        }
        image.depth_m[i] = 1.0F / (1.0F / depth_m + noise_per_m * sum * 1.732F);
      }
    }
    return image;
  }

  [[nodiscard]] static PoseCameraFromObject PoseAt(float time_s) {
    const Vec3 sway(0.5F * std::sin(1.9F * time_s), 0.6F * std::sin(1.3F * time_s),
                    0.3F * std::sin(1.1F * time_s));
    const Mat3 rotation = ExpSo3(sway) * ExpSo3(Vec3(1.1F, 0.5F, 0.2F));
    return {rotation, Vec3(0.06F * std::sin(1.7F * time_s), 0.03F * std::sin(2.1F * time_s),
                           0.62F + 0.05F * std::sin(1.2F * time_s))};
  }

 private:
  /// Distance along the ray to the box, or 0.
  [[nodiscard]] static float Hit(const Vec3& origin, const Vec3& direction) {
    float near = 0.0F;
    float far = 1e9F;
    for (int axis = 0; axis < 3; ++axis) {
      const float a = (-HalfSize()[axis] - origin[axis]) / direction[axis];
      const float b = (HalfSize()[axis] - origin[axis]) / direction[axis];
      near = std::max(near, std::min(a, b));
      far = std::min(far, std::max(a, b));
    }
    return near < far ? near : 0.0F;
  }
};

}  // namespace disflow::test
