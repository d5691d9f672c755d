// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/model_agreement.h"

#include <array>
#include <cmath>

namespace disflow {

bool IsBesideSurface(const DepthReader& depth, const PinholeCamera& camera, const Vec2& px,
                     float depth_m, float reach_m, float tolerance_m) noexcept {
  const float reach_px = reach_m * camera.fx_px / depth_m;
  const std::array<Vec2, 4> around{Vec2(reach_px, 0.0F), Vec2(-reach_px, 0.0F),
                                   Vec2(0.0F, reach_px), Vec2(0.0F, -reach_px)};
  for (const Vec2& beside_px : around) {
    const PixelAt pixel(px + beside_px);
    const float there_m = depth.AtOrZero(pixel.u, pixel.v);
    if (there_m > 0.0F && std::abs(there_m - depth_m) <= tolerance_m) return true;
  }
  return false;
}

}  // namespace disflow
