// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/flow/normal_equations.h"
#include "disflow/flow/residual_sums.h"
#include "disflow/memory/fixed_vector.h"
#include "disflow/memory/median.h"

/// @file
/// How residuals are added up: in line, since each frame adds thousands, but apart, since Eigen's
/// expressions cost everybody's compiler who includes tracker.h.

namespace disflow {

inline void NormalSums::Add(const Vec3& lever_m, const Vec3& gradient, float residual_m,
                            float weight, float per_radius) noexcept {
  const Vec3 turning = lever_m.cross(gradient);
  const Mat<float, 4, 1> head(gradient.x(), gradient.y(), gradient.z(), turning.x());
  const Mat<float, 4, 1> tail(turning.y(), turning.z(), per_radius, residual_m);
  const Mat<float, 4, 1> place(lever_m.x(), lever_m.y(), lever_m.z(), 1.0F);
  const Mat<float, 4, 1> weighted_head = weight * head;
  const Mat<float, 4, 1> weighted_tail = weight * tail;
  const Mat<float, 4, 1> weighted_place = weight * place;
  for (int k = 0; k < 4; ++k) {
    first_.col(k).head<4>() += head[k] * weighted_head;
    first_.col(k).tail<4>() += head[k] * weighted_tail;
    second_.col(k) += tail[k] * weighted_tail;
    moments_.col(k) += place[k] * weighted_place;
  }
}

/// The gates of section V-E: residual truncation, and no direction without a gradient.
[[nodiscard]] inline ResidualStatus Gate(const Residual& residual,
                                         const RegistrationConfig& config) noexcept {
  if (residual.status != ResidualStatus::kMatched) return residual.status;
  if (std::abs(residual.distance_m) > config.truncation_m) return ResidualStatus::kTruncated;
  if (residual.gradient_norm < config.min_gradient_norm) return ResidualStatus::kUnmatched;
  return ResidualStatus::kMatched;
}

/// Variance that is added to all residuals while the kernel is wide: as long as the pose is off
/// by more than the noise, a few very precise samples must not outvote all others.
[[nodiscard]] inline float BlurVariance(float scale_m) noexcept {
  constexpr float kShare = 0.1F;
  return kShare * kShare * scale_m * scale_m;
}

inline void ResidualSums::Add(const Residual& residual, const ResidualWeighting& weighting,
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
  const float narrow_m = config.robust_scale_sigmas * sigma_m;
  const float robust =
      GemanMcClure(residual_m, std::max(weighting.scale_m, weighting.widening * narrow_m));
  const float row_weight = weighting.trust * robust * std::min(residual.gradient_norm, 1.0F) /
                           (residual.variance_m2 + BlurVariance(weighting.scale_m));
  normals.Add(residual.point_m - center_m, per_norm * residual.gradient, residual_m, row_weight,
              per_norm * residual.per_radius);
  weighted_square_m2 += robust * residual_m * residual_m;
  weight += robust;
  weighted_generation += robust * residual.generation;
  information += row_weight;
  informed_tilt_rad2 += row_weight * residual.tilt_rad2;
  const float reach_m = weighting.inlier_reach * std::max(weighting.scale_m, narrow_m);
  if (std::abs(residual_m) < reach_m) ++inliers;
}

template <class Residuals>
ResidualSums AddResiduals(Residuals& residuals, const PoseObjectFromCamera& T_oc,
                          const Vec3& center_m, const ResidualWeighting& weighting,
                          Matching matching) noexcept {
  ResidualSums sums;
  for (int i = 0; i < residuals.size(); ++i) {
    sums.Add(residuals.At(i, T_oc, weighting.scale_m, matching), weighting, center_m);
  }
  return sums;
}

/// How far residuals are off under a pose, matched as by the last step, in their standard
/// deviations: the median, as that of a normal distribution, so 1 where these are right. 0 where
/// too few tell.
template <int kMost, class Residuals>
[[nodiscard]] float SpreadOf(Residuals& residuals, const PoseObjectFromCamera& T_oc) noexcept {
  constexpr int kFewest = 12;
  FixedVector<float, kMost> deviations;
  for (int i = 0; i < residuals.size(); ++i) {
    const Residual residual = residuals.At(i, T_oc, 0.0F, Matching::kLinear);
    if (residual.status != ResidualStatus::kMatched) continue;
    (void)deviations.push_back(std::abs(residual.distance_m) / std::sqrt(residual.variance_m2));
  }
  if (deviations.size() < kFewest) return 0.0F;
  return MedianOf(deviations.begin(), deviations.end()) / kMedianPerSigma;
}

}  // namespace disflow
