// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/contour_bend.h"

#include <algorithm>
#include <cmath>

namespace disflow {

float ContourBend(const OutlineProfile& profile) noexcept {
  constexpr float kLeastVariance_rad2 = 1e-8F;
  if (!(profile.near_m > 0.0F)) return 0.0F;
  // Angle between ray and surface: 0 where the ray touches a circle of radius R, from where
  // R (1 - cos angle) leads across the rays to the near window.
  const float sin_near = std::clamp(profile.cos_near, 0.0F, 1.0F);
  const float cos_near = std::sqrt(1.0F - sin_near * sin_near);
  const float turned = (1.0F - cos_near) * profile.inner_m / profile.near_m;
  const float near_rad = std::asin(sin_near);
  const float inner_rad = std::asin(std::clamp(profile.cos_inner, 0.0F, 1.0F));
  const float bent_rad = std::acos(std::max(1.0F - turned, 0.0F)) - near_rad;
  const float seen_rad = inner_rad - near_rad;
  const float off_rad = seen_rad - bent_rad;
  // Likelihood of a circle beside that of a plane, neither of which was likelier before.
  const float against = (off_rad * off_rad - seen_rad * seen_rad) /
                        (2.0F * std::max(profile.variance_rad2, kLeastVariance_rad2));
  const float round = 1.0F / (1.0F + std::exp(against));
  const float radius_m = profile.near_m / std::max(1.0F - cos_near, 1e-6F);
  const float behind_m =
      radius_m * sin_near - profile.near_m * cos_near / std::max(sin_near, 1e-3F);
  return std::sqrt(round) * std::max(behind_m, 0.0F);
}

}  // namespace disflow
