// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/model_drift.h"

#include <cmath>

namespace disflow {

float LeverOf(const RegistrationInformation& information) noexcept {
  constexpr float kLeast_m = 1e-3F;
  // Of residuals in all directions: sum w three times, sum w |x|^2 twice.
  const Vec6 isotropic = information.total.diagonal() + information.across.diagonal();
  const float weight = isotropic.head<3>().sum() / 3.0F;
  const float moment_m2 = isotropic.tail<3>().sum() / 2.0F;
  return std::fmax(std::sqrt(moment_m2 / weight), kLeast_m);
}

Mat6 WithDrift(const Mat6& covariance, float pieces, const PlacementScale& scale, float lever_m,
               const RegistrationConfig& config) noexcept {
  const float position_m = config.drift_px * scale.pixel_m;
  const float rotation_rad = config.drift_tilt * scale.depth_noise_m / lever_m;
  Mat6 result = (1.0F + pieces) * covariance;
  result.diagonal().head<3>().array() += pieces * position_m * position_m;
  result.diagonal().tail<3>().array() += pieces * rotation_rad * rotation_rad;
  return result;
}

}  // namespace disflow
