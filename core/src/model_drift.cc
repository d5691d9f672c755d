// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/model_drift.h"

#include <cmath>

namespace disflow {
namespace {

/// Variance of where the middle of one piece of surface is, in any direction [m^2].
float PlaceVariance(const Mat6& covariance, float outline_m,
                    const RegistrationConfig& config) noexcept {
  const float place_m2 = covariance.diagonal().head<3>().mean();
  return config.drift_noise * place_m2 + outline_m * outline_m;
}

}  // namespace

float LeverOf(const RegistrationInformation& information) noexcept {
  constexpr float kLeast_m = 1e-3F;
  // Of residuals in all directions: sum w three times, sum w |x|^2 twice.
  const Vec6 isotropic = information.total.diagonal() + information.across.diagonal();
  const float weight = isotropic.head<3>().sum() / 3.0F;
  const float moment_m2 = isotropic.tail<3>().sum() / 2.0F;
  return std::fmax(std::sqrt(moment_m2 / weight), kLeast_m);
}

float PieceVariance(const Mat6& covariance, const PlacementScale& scale,
                    const RegistrationConfig& config) noexcept {
  // Of a turn about any axis two thirds move a point in any one direction.
  const float turned_m2 =
      2.0F / 3.0F * scale.lever_m * scale.lever_m * covariance.diagonal().tail<3>().mean();
  return PlaceVariance(covariance, scale.outline_m, config) + config.drift_noise * turned_m2;
}

Mat6 DriftOf(const Mat6& covariance, const PlacementScale& scale,
             const RegistrationConfig& config) noexcept {
  const float bias_m = config.depth_bias_m;
  const float bias_rad = bias_m / scale.lever_m;
  const float views = 1.0F + scale.pieces;
  Mat6 result = scale.pieces * config.drift_noise * covariance;
  result.diagonal().head<3>().array() +=
      scale.pieces * PlaceVariance(covariance, scale.outline_m, config) + views * bias_m * bias_m;
  result.diagonal().tail<3>().array() += views * bias_rad * bias_rad;
  return result;
}

}  // namespace disflow
