// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/flow/normal_equations.h"
#include "disflow/flow/residual.h"

namespace disflow {

/// How the residuals of one kind are weighted in one step (section V-E and additions to the paper).
struct ResidualWeighting {
  const RegistrationConfig& config;
  float scale_m;          ///< Least width of the robust kernel.
  float widening = 1.0F;  ///< Of the robust kernel, see KernelWidth.
  float trust = 1.0F;     ///< How far this kind is believed, 0..1.
  /// A residual supports the pose if it is less than this many times as large as the kernel would
  /// be wide without the widening: 2 of edges, of which 95 % are where their noise is known.
  float inlier_reach = 1.0F;
};

/// Sums over the residuals of one kind in one step.
struct ResidualSums {
  int inliers = 0;  ///< Residuals within ResidualWeighting::inlier_reach.
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
