// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "disflow/config.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/field/distance_field.h"
#include "disflow/flow/residual.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// Residuals of a frame's surface samples: their distance d from the model's surface (section V-C,
/// d(x^o) = 0 if the pose is right), with the field's gradient as direction. A kind of residual as
/// residual.h wants it.
template <class Limits>
class SurfaceResiduals {
 public:
  using Field = DistanceField<Limits>;
  using Samples = FixedVector<SurfaceSample, Limits::kMaxRegistrationPoints>;

  /// Keeps references to its arguments.
  /// @param samples Camera frame.
  SurfaceResiduals(const Field& field, const Samples& samples,
                   const RegistrationConfig& config) noexcept
      : field_(field), samples_(samples), config_(config) {}

  [[nodiscard]] int size() const noexcept { return samples_.size(); }

  [[nodiscard]] Residual At(int i, const PoseObjectFromCamera& T_oc, float scale_m,
                            bool reuse) noexcept {
    const SurfaceSample& sample = samples_[i];
    Residual residual;
    residual.point_m = T_oc * sample.position_m;
    const Vec3 normal = T_oc.rotation() * sample.normal;
    const FieldMatch match = Match(i, residual.point_m, normal, scale_m, reuse);
    if (!match.found) {
      residual.status =
          match.normal_mismatch ? ResidualStatus::kNormalMismatch : ResidualStatus::kUnmatched;
      return residual;
    }
    residual.status = ResidualStatus::kMatched;
    residual.gradient = match.gradient;
    residual.gradient_norm = match.gradient.norm();
    residual.distance_m = match.distance_m;
    residual.variance_m2 = sample.variance_m2 + match.variance_m2;
    residual.generation = match.generation;
    const Vec3 tilt = match.gradient / residual.gradient_norm - normal;
    residual.tilt_rad2 = 0.5F * tilt.squaredNorm() - sample.normal_variance;
    return residual;
  }

 private:
  /// From this kernel width on the octree's coarse levels may pull samples that are far from any
  /// local GP.
  static constexpr float kCoarseScale_m = 0.002F;

  [[nodiscard]] FieldMatch Match(int i, const Vec3& x_o, const Vec3& n_o, float scale_m,
                                 bool reuse) noexcept {
    Correspondence& known = known_[static_cast<std::size_t>(i)];
    const FieldMatch match =
        reuse && known.cluster != kNoHandle
            ? field_.Reuse(known.cluster, known.beyond_variance_m2, x_o)
            : field_.FindMatch(x_o, n_o, config_.match_radius_m + scale_m, config_.min_normal_cos);
    known = {match.cluster, match.beyond_variance_m2};
    const bool coarse = !match.found && !match.normal_mismatch && scale_m > kCoarseScale_m;
    return coarse ? field_.FindCoarseMatch(x_o, n_o, config_.min_normal_cos) : match;
  }

  /// What a sample was matched with.
  struct Correspondence {
    Handle cluster;
    float beyond_variance_m2;
  };

  const Field& field_;
  const Samples& samples_;
  const RegistrationConfig& config_;
  /// Written by the first search.
  std::array<Correspondence, static_cast<std::size_t>(Limits::kMaxRegistrationPoints)> known_;
};

}  // namespace disflow
