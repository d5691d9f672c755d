// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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
  /// Squared angle between what the observation says of the gradient's direction and grad d: of a
  /// normal per component and less what its own noise explains, of an edge in the image [rad^2].
  float tilt_rad2 = 0.0F;
};

/// Where residuals are as large as the robust kernel is wide.
inline constexpr float kInlierWeight = 0.25F;
/// Where they are twice as large: of edges whose noise is known 95 %.
inline constexpr float kEdgeInlierWeight = 0.04F;

/// How the residuals of one kind are weighted in one step (section V-E and additions to the paper).
struct ResidualWeighting {
  const RegistrationConfig& config;
  float scale_m;       ///< Width of the robust kernel.
  float trust = 1.0F;  ///< How far this kind is believed, 0..1.
  /// Weight of the robust kernel from which on a residual supports the pose.
  float inlier_weight = kInlierWeight;
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
  /// The standard deviation that the residuals have by what is known of them, harmonic mean.
  [[nodiscard]] float std_m() const noexcept;
  /// Gates one residual, weights it, and adds it.
  /// @param center_m Centre of rotation, object frame. Defined in residual_sums_impl.h.
  void Add(const Residual& residual, const ResidualWeighting& weighting,
           const Vec3& center_m) noexcept;
};

/// Adds all residuals of one kind. Defined in residual_sums_impl.h.
template <class Residuals>
[[nodiscard]] ResidualSums AddResiduals(Residuals& residuals, const PoseObjectFromCamera& T_oc,
                                        const Vec3& center_m, const ResidualWeighting& weighting,
                                        Matching matching) noexcept;

}  // namespace disflow
