// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "disflow/config.h"
#include "disflow/flow/normal_equations.h"
#include "disflow/geometry/transform.h"

/// @file
/// The seam between what is compared with the model and the pose that is estimated from it.
///
/// A kind of residual is a class in a file of its own (surface_residual.h, edge_residual.h) with
/// - `int size() const`: how many observations there are in this frame,
/// - `Residual At(int i, const PoseObjectFromCamera& T_oc, float scale_m, Matching)`: observation
///   i under a pose, searched for within reach of a robust kernel of width scale_m, or matched with
///   what the last search found.
///
/// Gates, weights and sums are the same for all kinds and are here. A further kind is one more
/// file, and one more line in Registration::Linearise().

namespace disflow {

/// What became of one observation in one step.
enum class ResidualStatus : std::uint8_t {
  kMatched,
  kUnmatched,       ///< Nothing of the model is near, or what is near tells no direction.
  kUnexpected,      ///< The same, of what need not be in the model.
  kNormalMismatch,  ///< Surface is near, but none whose normal agrees.
  kTruncated,       ///< Farther off than RegistrationConfig::truncation_m.
};

/// How far one observation is off the model under a pose, to first order in the observation's
/// position. Object frame.
struct Residual {
  ResidualStatus status = ResidualStatus::kUnmatched;  ///< The rest has a meaning if kMatched.
  Vec3 point_m = Vec3::Zero();                         ///< x^o = T_oc x^c, equation (2).
  Vec3 gradient = Vec3::Zero();                        ///< grad d
  /// |grad d|; 1 where `gradient` is of unit length by construction.
  float gradient_norm = 1.0F;
  float distance_m = 0.0F;   ///< d
  float variance_m2 = 0.0F;  ///< Of d: observation and model together.
  float per_radius = 0.0F;   ///< Derivative of d by the radius of the object's edges.
  float generation = 0.0F;   ///< Of the piece of surface, see Cluster.
  /// Squared angle between the observation's normal and grad d, per component, less what the
  /// observation's own noise explains [rad^2].
  float tilt_rad2 = 0.0F;
};

/// How the residuals of one kind are weighted in one step (section V-E and additions to the paper).
struct ResidualWeighting {
  const RegistrationConfig& config;
  float scale_m;       ///< Width of the robust kernel.
  float trust = 1.0F;  ///< How far this kind is believed, 0..1.
};

/// How observations find what they are matched with.
enum class Matching : std::uint8_t {
  kSearch,  ///< Anywhere near.
  kKeep,    ///< In the piece of surface of the last step, whose field is asked anew.
  kLinear,  ///< The same, by what its field was there, to first order.
};

/// Sums over the residuals of one kind in one step.
struct ResidualSums {
  int inliers = 0;  ///< Residuals that the robust kernel hardly weakens.
  int unmatched = 0;
  int unexpected = 0;
  int normal_mismatch = 0;
  int truncated = 0;
  /// With the robust kernel's weights alone.
  float weight = 0.0F;
  float weighted_square_m2 = 0.0F;
  float weighted_generation = 0.0F;
  /// With the weights in the normal equations.
  float information = 0.0F;
  float informed_tilt_rad2 = 0.0F;

  NormalSums normals;  ///< What they add to the normal equations.

  [[nodiscard]] float mean_generation() const noexcept;
  [[nodiscard]] float mean_tilt_rad2() const noexcept;  ///< Not negative.
  [[nodiscard]] float rms_m() const noexcept;
  /// Gates one residual, weights it, and adds it.
  /// @param center_m Centre of rotation, object frame.
  void Add(const Residual& residual, const ResidualWeighting& weighting,
           const Vec3& center_m) noexcept;
};

/// Weight of the robust kernel from which on a residual supports the pose: it is then smaller than
/// the kernel's width.
inline constexpr float kInlierWeight = 0.25F;

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
  const float robust =
      GemanMcClure(residual_m, std::max(weighting.scale_m, config.robust_scale_sigmas * sigma_m));
  const float row_weight = weighting.trust * robust * std::min(residual.gradient_norm, 1.0F) /
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

/// Adds all residuals of one kind.
template <class Residuals>
[[nodiscard]] ResidualSums AddResiduals(Residuals& residuals, const PoseObjectFromCamera& T_oc,
                                        const Vec3& center_m, const ResidualWeighting& weighting,
                                        Matching matching) noexcept {
  ResidualSums sums;
  for (int i = 0; i < residuals.size(); ++i) {
    sums.Add(residuals.At(i, T_oc, weighting.scale_m, matching), weighting, center_m);
  }
  return sums;
}

}  // namespace disflow
