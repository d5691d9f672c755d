// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "disflow/field/distance_field.h"

namespace disflow {

/// Posterior variances of the distance (section IV). Local GPs keep no factor of their covariance;
/// the one asked last is factorised anew and kept, so neighbouring points cost little. A view: the
/// model must not change while it exists.
template <class Limits>
class PosteriorVariance {
 public:
  using Field = DistanceField<Limits>;
  using Workspace = GpWorkspace<Limits::kMaxTrainingSamples>;

  PosteriorVariance(const Field& field, Workspace& workspace) noexcept
      : field_(field), workspace_(workspace) {}

  /// V[d(x)] [m^2] by one cluster's GP.
  /// @param nearest_m Distance from x to the cluster's nearest sample.
  [[nodiscard]] float At(Handle handle, const Vec3& x_m, float nearest_m) noexcept {
    const auto& cluster = field_.store()[handle];
    if (handle != factorised_) {
      factorised_ = kNoHandle;
      if (cluster.gp.trained() && Factorise(cluster.gp, field_.hyperparameters(), workspace_))
        factorised_ = handle;
    }
    // Without a trained GP the prior alone: a plane of uncertain slope.
    if (factorised_ == kNoHandle)
      return OfSlope(std::fmax(nearest_m, 0.5F * field_.config().cell_size_m));
    return std::fmax(Covariance(cluster.gp, field_.hyperparameters(), workspace_, x_m)(0, 0), 0.0F);
  }

  /// What the prior's uncertain slope makes of a distance over which nothing was seen.
  [[nodiscard]] float OfSlope(float length_m) const noexcept {
    const float std_m = field_.config().prior_gradient_std * length_m;
    return std_m * std_m;
  }

 private:
  const Field& field_;
  Workspace& workspace_;
  Handle factorised_ = kNoHandle;
};

}  // namespace disflow
