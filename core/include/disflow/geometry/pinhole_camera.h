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

  [[nodiscard]] bool IsValid() const noexcept {
    return std::isfinite(fx_px) && std::isfinite(fy_px) && std::isfinite(cx_px) &&
           std::isfinite(cy_px) && fx_px > 0.0F && fy_px > 0.0F;
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
};

}  // namespace disflow
