// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/residual.h"

#include <cmath>

namespace disflow {
namespace {

/// Sums of weights below this are none.
constexpr float kNoWeight = 1e-9F;
/// Weight of the robust kernel from which on a residual supports the pose: it is then smaller than
/// the kernel's width.
constexpr float kInlierWeight = 0.25F;

/// The gates of section V-E: residual truncation, and no direction without a gradient.
ResidualStatus Gate(const Residual& residual, const RegistrationConfig& config) noexcept {
  if (residual.status != ResidualStatus::kMatched) return residual.status;
  if (std::abs(residual.distance_m) > config.truncation_m) return ResidualStatus::kTruncated;
  if (residual.gradient_norm < config.min_gradient_norm) return ResidualStatus::kUnmatched;
  return ResidualStatus::kMatched;
}

/// Variance that is added to all residuals while the kernel is wide: as long as the pose is off
/// by more than the noise, a few very precise samples must not outvote all others.
float BlurVariance(float scale_m) noexcept {
  constexpr float kShare = 0.1F;
  return kShare * kShare * scale_m * scale_m;
}

}  // namespace

float ResidualSums::mean_generation() const noexcept {
  return weighted_generation / std::fmax(weight, kNoWeight);
}

float ResidualSums::mean_tilt_rad2() const noexcept {
  return information > 0.0F ? std::fmax(informed_tilt_rad2 / information, 0.0F) : 0.0F;
}

float ResidualSums::rms_m() const noexcept {
  return std::sqrt(weighted_square_m2 / std::fmax(weight, kNoWeight));
}

void ResidualSums::Add(const Residual& residual, const ResidualWeighting& weighting,
                       const Vec3& center_m) noexcept {
  const RegistrationConfig& config = weighting.config;
  switch (Gate(residual, config)) {
    case ResidualStatus::kUnmatched:
      ++unmatched;
      return;
    case ResidualStatus::kUnexpected:
      ++unexpected;
      return;
    case ResidualStatus::kNormalMismatch:
      ++normal_mismatch;
      return;
    case ResidualStatus::kTruncated:
      ++truncated;
      return;
    case ResidualStatus::kMatched:
      break;
  }
  // d / |grad d| is the distance to first order. |grad d| < 1 tells how little is known: the
  // gradient weighting of section V-E.
  const float per_norm = 1.0F / residual.gradient_norm;
  const float residual_m = per_norm * residual.distance_m;
  const float sigma_m = std::sqrt(residual.variance_m2);
  const float robust =
      GemanMcClure(residual_m, std::fmax(weighting.scale_m, config.robust_scale_sigmas * sigma_m));
  const float row_weight = weighting.trust * robust * std::fmin(residual.gradient_norm, 1.0F) /
                           (residual.variance_m2 + BlurVariance(weighting.scale_m));
  normals.Add(residual.point_m - center_m, per_norm * residual.gradient, residual_m, row_weight,
              per_norm * residual.per_radius);
  weighted_square_m2 += robust * residual_m * residual_m;
  weight += robust;
  weighted_generation += robust * residual.generation;
  information += row_weight;
  informed_tilt_rad2 += row_weight * residual.tilt_rad2;
  if (robust > kInlierWeight) ++inliers;
}

}  // namespace disflow
