// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

#include "disflow/config.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/field/distance_field.h"
#include "disflow/flow/residual.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// How far along the surface the model's nearest sample may lie from where an observed one falls
/// [m]. Of pixels that are wide the model's samples lie as far apart, and those of an image in
/// which the object has moved by half a block fall between them. An addition to the paper.
[[nodiscard]] inline float MatchRadius(const SurfaceSample& observed,
                                       const RegistrationConfig& config) noexcept {
  return std::max(config.match_radius_m, observed.reach_m);
}

/// Residuals of a frame's surface samples: their distance d from the model's surface (section V-C,
/// d(x^o) = 0 if the pose is right), with the field's gradient as direction. A kind of residual as
/// residual.h wants it.
template <class Limits>
class SurfaceResiduals {
 public:
  using Field = DistanceField<Limits>;
  using Samples = FixedVector<SurfaceSample, Limits::kMaxRegistrationPoints>;

  /// What a sample is matched with, and where the field was asked. Near the end the points hardly
  /// move: to first order the field about them is what it was.
  struct Correspondence {
    FieldMatch match;
    Vec3 place_m;
    bool coarse;  ///< Looked for on the coarse levels, which are nothing to end with.
  };
  /// Written by the first search.
  using Known =
      std::array<Correspondence, static_cast<std::size_t>(Limits::kMaxRegistrationPoints)>;

  /// Keeps references to its arguments.
  /// @param samples Camera frame.
  SurfaceResiduals(const Field& field, const Samples& samples, const RegistrationConfig& config,
                   Known& known) noexcept
      : field_(field), samples_(samples), config_(config), known_(known) {}

  [[nodiscard]] int size() const noexcept { return samples_.size(); }

  [[nodiscard]] Residual At(int i, const PoseObjectFromCamera& T_oc, float scale_m,
                            Matching matching) noexcept {
    const SurfaceSample& sample = samples_[i];
    const Vec3 x_o = T_oc * sample.position_m;
    Correspondence& known = known_[static_cast<std::size_t>(i)];
    const bool keep = matching == Matching::kKeep;
    if (matching == Matching::kSearch || known.coarse || (keep && !known.match.found)) {
      known = Search(x_o, T_oc.rotation() * sample.normal, MatchRadius(sample, config_), scale_m);
    } else if (keep) {
      known.match = field_.Reuse(known.match, x_o);
      known.place_m = x_o;
    }
    return ResidualOf(sample, T_oc, x_o, known);
  }

 private:
  /// From this kernel width on the octree's coarse levels may pull samples that are far from any
  /// local GP.
  static constexpr float kCoarseScale_m = 0.002F;

  [[nodiscard]] Correspondence Search(const Vec3& x_o, const Vec3& n_o, float radius_m,
                                      float scale_m) const noexcept {
    Correspondence found;
    found.place_m = x_o;
    found.match = field_.FindMatch(x_o, n_o, radius_m + scale_m, config_.min_normal_cos);
    found.coarse = !found.match.found && !found.match.normal_mismatch && scale_m > kCoarseScale_m;
    if (found.coarse) found.match = field_.FindCoarseMatch(x_o, n_o, config_.min_normal_cos);
    return found;
  }

  /// The field about the place where it was asked last, to first order.
  [[nodiscard]] static Residual ResidualOf(const SurfaceSample& sample,
                                           const PoseObjectFromCamera& T_oc, const Vec3& x_o,
                                           const Correspondence& known) noexcept {
    const FieldMatch& match = known.match;
    Residual residual;
    residual.point_m = x_o;
    if (!match.found) {
      residual.status =
          match.normal_mismatch ? ResidualStatus::kNormalMismatch : ResidualStatus::kUnmatched;
      return residual;
    }
    residual.status = ResidualStatus::kMatched;
    residual.gradient = match.gradient;
    residual.gradient_norm = match.gradient.norm();
    residual.distance_m = match.distance_m + match.gradient.dot(x_o - known.place_m);
    residual.variance_m2 = sample.variance_m2 + match.variance_m2;
    residual.generation = match.generation;
    const Vec3 tilt = match.gradient / residual.gradient_norm - T_oc.rotation() * sample.normal;
    residual.tilt_rad2 = 0.5F * tilt.squaredNorm() - sample.normal_variance;
    return residual;
  }

  const Field& field_;
  const Samples& samples_;
  const RegistrationConfig& config_;
  Known& known_;
};

}  // namespace disflow
