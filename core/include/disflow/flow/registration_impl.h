// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/flow/registration.h"
#include "disflow/flow/registration_pace.h"
#include "disflow/flow/residual_sums_impl.h"
#include "disflow/flow/sample_match.h"

/// @file
/// Scores and steps of a registration: definitions of members of Registration.

namespace disflow {

template <class Limits>
float Registration<Limits>::Score(const Field& field, const RegistrationConfig& config,
                                  const PoseObjectFromCamera& T_oc) const noexcept {
  if (samples_.empty()) return 0.0F;
  const int wanted = std::min(config.score_points, samples_.size());
  float sum = 0.0F;
  for (int i = 0; i < wanted; ++i) {
    const SurfaceSample& sample = samples_[i * samples_.size() / wanted];
    const auto match = MatchOf(field, config, T_oc, sample);
    if (!match.found) continue;
    sum += Explained(match.distance_m, sample.variance_m2 + match.variance_m2);
  }
  return sum / static_cast<float>(wanted);
}

template <class Limits>
float Registration<Limits>::ScoreOfAligned(const Field& field, const RegistrationConfig& config,
                                           const PoseObjectFromCamera& T_oc) noexcept {
  if (samples_.empty()) return 0.0F;
  SurfaceResiduals<Limits> surfaces(field, samples_, config, known_);
  float sum = 0.0F;
  for (int i = 0; i < surfaces.size(); ++i) {
    const Residual residual = surfaces.At(i, T_oc, 0.0F, Matching::kLinear);
    if (residual.status != ResidualStatus::kMatched) continue;
    sum += Explained(residual.distance_m, residual.variance_m2);
  }
  return sum / static_cast<float>(samples_.size());
}

template <class Limits>
float Registration<Limits>::EdgeScore(const Model& model_edges, const RegistrationConfig& config,
                                      const PoseObjectFromCamera& T_oc) noexcept {
  EdgeResiduals<Limits> edges(model_edges, *edges_, config, edge_index_, known_edges_);
  float sum = 0.0F;
  int expected = 0;
  for (int i = 0; i < edges.size(); ++i) {
    const Residual edge = edges.At(i, T_oc, 0.0F, Matching::kSearch);
    if (edge.status != ResidualStatus::kUnexpected) ++expected;
    if (edge.status != ResidualStatus::kMatched) continue;
    sum += GemanMcClure(edge.distance_m, 2.0F * std::sqrt(edge.variance_m2));
  }
  return expected == 0 ? 0.0F : sum / static_cast<float>(expected);
}

template <class Limits>
RegistrationResult Registration<Limits>::Align(const Field& field, const Model& model_edges,
                                               const RegistrationConfig& config,
                                               const PoseObjectFromCamera& T_start,
                                               const PoseObjectFromCamera& T_predicted,
                                               RobustScale scale, StepLimit steps) noexcept {
  SurfaceResiduals<Limits> surfaces(field, samples_, config, known_);
  EdgeResiduals<Limits> edges(model_edges, *edges_, config, edge_index_, known_edges_);
  Result result;
  result.T_oc = T_start;
  result.points = samples_.size();
  result.center_c = center_c_;
  result.rounding = edges.known_rounding();
  NormalEquations joint;
  NormalEquations equations;
  RegistrationPace pace(scale, steps);
  while (!pace.done()) {
    // V-D: H = sum J^T J and b = sum J^T d, at the current pose.
    joint = Linearise(surfaces, edges, config, pace.scale(), pace.matching(), result);
    equations = joint.WithoutRadius();
    result.information.total = equations.h;
    // V-E: the penalty on what deviates from the predicted motion.
    equations.AddPrior(DeviationAbout(center_c_, result.T_oc, T_predicted), config.temporal_std_m,
                       config.temporal_std_rad);
    // V-D: H xi = -b, damped as V-E says.
    Vec6 xi;
    if (result.inliers < kMinInliers || !equations.Solve(config.damping, xi)) {
      result.solved = false;
      return result;
    }
    // V-D: T <- exp(xi) T.
    result.T_oc = StepAbout(result.center_m, xi, result.T_oc);
    edges.SetRadius(edges.radius_m() + joint.RadiusStep(xi));
    result.solved = true;
    pace.Advance(xi, result.std_m);
    result.iterations = pace.steps();
  }
  // Once, at the end: it costs a factorisation.
  if (result.solved) {
    result.rounding = {edges.radius_m(), joint.RadiusVariance(equations)};
    result.spread = SpreadOf<Limits::kMaxRegistrationPoints>(surfaces, result.T_oc);
    result.edge_spread = SpreadOf<Limits::kMaxEdgePoints>(edges, result.T_oc);
    result.information.of_edge_errors = OfEdgeErrors(edges, config, pace.scale(), result);
  }
  return result;
}

template <class Limits>
RegistrationInformation Registration<Limits>::KnownInformation(const Field& field,
                                                               const Model& model_edges,
                                                               const RegistrationConfig& config,
                                                               Result result) noexcept {
  for (auto& correspondence : known_) {
    FieldMatch& match = correspondence.match;
    match.found = match.found && !field.store()[match.cluster].shift_free;
  }
  SurfaceResiduals<Limits> surfaces(field, samples_, config, known_);
  EdgeResiduals<Limits> edges(model_edges, *edges_, config, edge_index_, true);
  edges.SetRadius(result.rounding.radius_m);
  const RobustScale settled;
  // Finds what the edges are matched with.
  (void)AddResiduals(edges, result.T_oc, result.center_m, {config, settled.edges_m},
                     Matching::kSearch);
  result.information.total =
      Linearise(surfaces, edges, config, settled, Matching::kLinear, result).WithoutRadius().h;
  result.information.of_edge_errors = OfEdgeErrors(edges, config, settled, result);
  return result.information;
}

/// What the edges of the last step tell by errors of their directions, and of how far they are.
template <class Limits>
Mat6 Registration<Limits>::OfEdgeErrors(EdgeResiduals<Limits>& edges,
                                        const RegistrationConfig& config, const RobustScale& scale,
                                        const Result& result) noexcept {
  const ResidualWeighting weighting{
      .config = config, .scale_m = scale.edges_m, .trust = result.edge_trust};
  ResidualSums along;
  ResidualSums behind;
  for (int i = 0; i < edges.size(); ++i) {
    const Residual edge = edges.At(i, result.T_oc, 0.0F, Matching::kLinear);
    along.Add(edges.Along(i, result.T_oc, edge), weighting, result.center_m);
    behind.Add(edges.Behind(i, result.T_oc, edge), weighting, Vec3::Zero());
  }
  NormalEquations of_directions;
  NormalEquations of_depths;
  of_directions += along.normals;
  of_depths += behind.normals;
  Mat6 by_errors = along.mean_tilt_rad2() * of_directions.h;
  // A shift along the ray shifts nothing in the image.
  by_errors.bottomRightCorner<3, 3>() += of_depths.h.bottomRightCorner<3, 3>();
  return by_errors;
}

template <class Limits>
NormalEquations Registration<Limits>::Linearise(SurfaceResiduals<Limits>& surfaces,
                                                EdgeResiduals<Limits>& edges,
                                                const RegistrationConfig& config,
                                                const RobustScale& scale, Matching matching,
                                                Result& result) const noexcept {
  NormalEquations equations;
  const PoseObjectFromCamera& T_oc = result.T_oc;
  const Vec3 center_m = T_oc * center_c_;
  const ResidualSums surface = AddResiduals(
      surfaces, T_oc, center_m, {config, scale.surface_m, surface_width_.factor()}, matching);
  equations += surface.normals;
  // Of the surface alone: errors of the field's gradients do not touch the edges.
  result.information.surface = equations.h;
  result.information.across = equations.Isotropic() - equations.h;
  result.information.gradient_variance_rad2 = kFieldsTilt * surface.mean_tilt_rad2();
  const ResidualSums edge = AddResiduals(edges, T_oc, center_m,
                                         {.config = config,
                                          .scale_m = scale.edges_m,
                                          .trust = result.edge_trust,
                                          .inlier_reach = kEdgeInlierReach},
                                         matching);
  equations += edge.normals;

  const EdgeRounding& known = edges.known_rounding();
  equations.AddRadiusPrior(edges.radius_m() - known.radius_m, known.variance_m2);

  result.center_m = center_m;
  result.inliers = surface.inliers;
  result.unmatched = surface.unmatched;
  result.truncated = surface.truncated;
  result.normal_mismatch = surface.normal_mismatch;
  result.generation = surface.mean_generation();
  result.rms_m = surface.rms_m();
  result.std_m = surface.std_m();
  result.edge_inliers = edge.inliers;
  result.edge_trust =
      EdgeTrust(config.edge_agreement, edges.size() - edge.unexpected, edge.inliers);
  return equations;
}

}  // namespace disflow
