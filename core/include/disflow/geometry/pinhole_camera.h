// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "disflow/types.h"

namespace disflow {

/// Pinhole camera without distortion; pixel centres are at integer coordinates.
struct PinholeCamera {
  float fx_px = 0.0F;
  float fy_px = 0.0F;
  float cx_px = 0.0F;
  float cy_px = 0.0F;

  /// Of a lens that exists: at the optical axis a pixel spans more than a microradian and less than
  /// an eighth of a turn.
  [[nodiscard]] bool IsValid() const noexcept {
    return IsFocalLength(fx_px) && IsFocalLength(fy_px) && std::isfinite(cx_px) &&
           std::isfinite(cy_px);
  }
  /// Whether all pixels of an image look into the half-space in front of the camera, within 87
  /// degrees of the optical axis. What is farther off no plane can image.
  [[nodiscard]] bool CanImage(int width_px, int height_px) const noexcept {
    return IsInFront(cx_px, width_px, fx_px) && IsInFront(cy_px, height_px, fy_px);
  }
  /// Direction with unit z through a pixel, camera frame.
  [[nodiscard]] Vec3 Ray(float u_px, float v_px) const noexcept {
    return {(u_px - cx_px) / fx_px, (v_px - cy_px) / fy_px, 1.0F};
  }
  [[nodiscard]] Vec3 BackProject(float u_px, float v_px, float depth_m) const noexcept {
    return depth_m * Ray(u_px, v_px);
  }
  /// Pixel of a point in the camera frame; the caller ensures z > 0.
  [[nodiscard]] Vec2 Project(const Vec3& x_c) const noexcept {
    const float inverse_z = 1.0F / x_c.z();
    return {fx_px * x_c.x() * inverse_z + cx_px, fy_px * x_c.y() * inverse_z + cy_px};
  }

 private:
  // Both written so that NaN is not.
  [[nodiscard]] static bool IsFocalLength(float f_px) noexcept {
    constexpr float kShortest_px = 1.0F;
    constexpr float kLongest_px = 1e6F;
    return f_px >= kShortest_px && f_px <= kLongest_px;
  }
  [[nodiscard]] static bool IsInFront(float center_px, int size_px, float f_px) noexcept {
    constexpr float kSteepest = 20.0F;  // tan 87 degrees
    const auto last_px = static_cast<float>(size_px - 1);
    return std::abs(center_px) <= kSteepest * f_px &&
           std::abs(last_px - center_px) <= kSteepest * f_px;
  }
};

/// Pixel nearest to a place in the image, which may lie anywhere; what is farther off than any
/// image reaches, and what is not a number, is some pixel outside of all images.
struct PixelAt {
  explicit PixelAt(const Vec2& px) noexcept : u(Nearest(px.x())), v(Nearest(px.y())) {}
  int u;
  int v;

  /// The same along one axis, of a place that is known to be nearer than that.
  [[nodiscard]] static int NearestInReach(float px) noexcept {
    // As std::lround(), which most compilers call as a function: a fifth of the time of the edges.
    const int whole = static_cast<int>(px);
    const float rest_px = px - static_cast<float>(whole);
    return whole + int{rest_px >= 0.5F} - int{rest_px <= -0.5F};
  }

 private:
  [[nodiscard]] static int Nearest(float px) noexcept {
    constexpr float kFarthest_px = 1e6F;
    const float above_px = px > -kFarthest_px ? px : -kFarthest_px;  // NaN too
    return NearestInReach(above_px < kFarthest_px ? above_px : kFarthest_px);
  }
};

}  // namespace disflow
