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
    // Without a trained GP the prior alone: a plane of uncertain slope.
    if (!Factorised(handle))
      return OfSlope(std::fmax(nearest_m, 0.5F * field_.config().cell_size_m));
    return Posterior(handle, x_m);
  }

  /// Variance of the surface along its normal [m^2], at one of its points, object frame: how far
  /// off it may be. Added to what the samples leave open between and beyond them are two errors
  /// of the samples that do not average out.
  [[nodiscard]] float OfSurface(Handle handle, const Vec3& x_m, float nearest_m) noexcept {
    // Of the sample's variance; measured on simulated sequences (docs/results.md).
    constexpr float kAlike = 5.0F;  // Observations of one place err alike: same pixels, same steps.
    constexpr float kChain = 16.0F;  // Each piece of surface is placed by registration to another.
    // Real surface is smoother than the prior's draws, so between samples the posterior is too
    // large, while beyond them it is right.
    const float beyond = nearest_m / field_.config().merge_radius_m;
    const float open_m2 =
        Factorised(handle) ? beyond * beyond * Posterior(handle, x_m) : OfSlope(nearest_m);
    const auto& cluster = field_.store()[handle];
    const float pieces_m2 = cluster.generation * field_.piece_variance_m2();
    return open_m2 + pieces_m2 +
           (kAlike + kChain * cluster.generation) * SampleVariance(cluster.samples, x_m);
  }

  /// What the prior's uncertain slope makes of a distance over which nothing was seen.
  [[nodiscard]] float OfSlope(float length_m) const noexcept {
    return SlopeVariance(field_.config().prior_gradient_std, length_m);
  }

 private:
  [[nodiscard]] bool Factorised(Handle handle) noexcept {
    if (handle == factorised_) return true;
    const auto& gp = field_.store()[handle].gp;
    const bool done = gp.trained() && workspace_.Factorise(gp);
    factorised_ = done ? handle : kNoHandle;
    return done;
  }

  /// Of the GP that is factorised.
  [[nodiscard]] float Posterior(Handle handle, const Vec3& x_m) const noexcept {
    const auto& gp = field_.store()[handle].gp;
    return std::fmax(workspace_.Variance(gp, x_m), 0.0F);
  }

  /// Mean over the samples, those near x first of all.
  template <class Samples>
  [[nodiscard]] float SampleVariance(const Samples& samples, const Vec3& x_m) const noexcept {
    const float half_m = 0.5F * field_.config().merge_radius_m;
    float weight_sum = 0.0F;
    float variance_sum = 0.0F;
    for (const ModelSample& sample : samples) {
      const float closeness = 1.0F / ((sample.position_m - x_m).squaredNorm() + half_m * half_m);
      weight_sum += closeness * closeness;
      variance_sum += closeness * closeness * sample.variance_m2;
    }
    return variance_sum / weight_sum;
  }

  const Field& field_;
  Workspace& workspace_;
  Handle factorised_ = kNoHandle;
};

}  // namespace disflow
