// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/inverse_depth_block.h"

#include <algorithm>

namespace disflow {

InverseDepthPlane InverseDepthPlane::Fit(const PixelMoments& m) noexcept {
  InverseDepthPlane plane;
  constexpr float kMinPixels = 4.0F;
  if (m.n < kMinPixels) return plane;
  const float inverse_n = 1.0F / m.n;
  plane.n = m.n;
  plane.mean_u = m.u * inverse_n;
  plane.mean_v = m.v * inverse_n;
  const float cuu = m.uu - m.u * plane.mean_u;
  const float cvv = m.vv - m.v * plane.mean_v;
  const float cuv = m.uv - m.u * plane.mean_v;
  const float cuw = m.uw - plane.mean_u * m.w;
  const float cvw = m.vw - plane.mean_v * m.w;
  const float cww = m.ww - m.w * m.w * inverse_n;
  const float determinant = cuu * cvv - cuv * cuv;
  // Pixels (nearly) on one line do not span a plane.
  if (determinant < 0.05F * cuu * cvv || determinant <= 0.0F) return plane;
  plane.inverse_uu = cvv / determinant;
  plane.inverse_vv = cuu / determinant;
  plane.inverse_uv = -cuv / determinant;
  plane.slope_u = plane.inverse_uu * cuw + plane.inverse_uv * cvw;
  plane.slope_v = plane.inverse_uv * cuw + plane.inverse_vv * cvw;
  plane.mean_w = m.w_reference + m.w * inverse_n;
  const float residual = cww - plane.slope_u * cuw - plane.slope_v * cvw;
  plane.residual_variance = std::max(0.0F, residual) / (m.n - 3.0F);
  plane.valid = true;
  return plane;
}

}  // namespace disflow
