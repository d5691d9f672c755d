// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "disflow/config.h"
#include "disflow/depth/edge_sampler.h"
#include "disflow/field/distance_field.h"
#include "disflow/field/edge_map.h"
#include "disflow/flow/edge_residual.h"
#include "disflow/flow/normal_equations.h"
#include "disflow/flow/pose_uncertainty.h"

namespace disflow {

/// Registers observed samples to the distance field (sections V-B to V-D).
///
/// Additions to the paper: weights 1/sigma^2 with a robust kernel whose width shrinks from step to
/// step (graduated non-convexity), gates on normal agreement and matching distance, rotation about
/// the observed centroid, occluding edges.
template <class Limits>
class Registration {
 public:
  using Field = DistanceField<Limits>;
  using Edges = typename EdgeSampler<Limits>::Edges;
  using Model = EdgeMap<Limits::kMaxModelEdges>;
  using Samples = FixedVector<SurfaceSample, Limits::kMaxRegistrationPoints>;

  /// Widths of the robust kernels. Edges of a view that were not seen before find others nearby, so
  /// that theirs has to be narrow unless the pose is being searched for.
  struct RobustScale {
    float surface_m = 0.0F;
    float edges_m = 0.0F;

    [[nodiscard]] RobustScale Halved() const noexcept { return {0.5F * surface_m, 0.5F * edges_m}; }
  };

  struct Result {
    bool solved = false;
    PoseObjectFromCamera T_oc;
    RegistrationInformation information;  ///< At the end, about center_m, object frame.
    Vec3 center_m = Vec3::Zero();         ///< Centre of rotation, object frame.
    int iterations = 0;
    int inliers = 0;
    int edge_inliers = 0;
    float edge_trust = 1.0F;  ///< How far edges are believed, 0..1: as far as they agree.
    float rms_m = 0.0F;
    float generation = 0.0F;  ///< Mean over the surface that was registered to, see Cluster.
    int unmatched = 0;
    int truncated = 0;
    int normal_mismatch = 0;
  };

  /// Takes an even subset of a frame's samples (camera frame) as the points to register.
  template <class FrameSamples>
  void SetObservations(const FrameSamples& samples, const Edges& edges) noexcept {
    samples_.clear();
    const int wanted = std::min(samples.size(), Limits::kMaxRegistrationPoints);
    center_c_.setZero();
    for (int i = 0; i < wanted; ++i) {
      const SurfaceSample& sample =
          samples[static_cast<int>(static_cast<std::int64_t>(i) * samples.size() / wanted)];
      (void)samples_.push_back(sample);
      center_c_ += sample.position_m;
    }
    if (wanted > 0) center_c_ /= static_cast<float>(wanted);
    edges_ = &edges;
  }
  [[nodiscard]] const Vec3& center_c() const noexcept { return center_c_; }
  [[nodiscard]] int size() const noexcept { return samples_.size(); }

  /// Share of the observed points that the model explains under a pose, 0..1. Unmatched points
  /// count 0.
  [[nodiscard]] float Score(const Field& field, const RegistrationConfig& config,
                            const PoseObjectFromCamera& T_oc) const noexcept {
    if (samples_.empty()) return 0.0F;
    constexpr float kTolerance_m = 0.003F;
    const int wanted = std::min(config.score_points, samples_.size());
    float sum = 0.0F;
    for (int i = 0; i < wanted; ++i) {
      const SurfaceSample& sample = samples_[i * samples_.size() / wanted];
      const auto match = field.FindMatch(T_oc * sample.position_m, T_oc.rotation() * sample.normal,
                                         config.match_radius_m, config.min_normal_cos);
      if (!match.found) continue;
      const float expected = kTolerance_m * kTolerance_m + sample.variance_m2 + match.variance_m2;
      sum += expected / (expected + match.distance_m * match.distance_m);
    }
    return sum / static_cast<float>(wanted);
  }

  /// Share of the observed occluding edges that lie on edges of the model, 0..1. Tells apart poses
  /// between which the surface could slide.
  [[nodiscard]] float EdgeScore(const Model& model_edges, const RegistrationConfig& config,
                                const PoseObjectFromCamera& T_oc) const noexcept {
    if (edges_->empty()) return 0.0F;
    float sum = 0.0F;
    for (const EdgePoint& point : *edges_) {
      const auto edge =
          FindEdge(model_edges, config.edge_std_px, point, T_oc, config.match_radius_m);
      if (edge.found) sum += GemanMcClure(edge.residual_m, 2.0F * edge.sigma_m);
    }
    return sum / static_cast<float>(edges_->size());
  }

  /// Iterates closed-form steps from T_start.
  /// @param T_predicted Centre of the temporal regulariser.
  /// @param scale Widths of the robust kernels at the first step, halved at each.
  [[nodiscard]] Result Align(const Field& field, const Model& model_edges,
                             const RegistrationConfig& config, const PoseObjectFromCamera& T_start,
                             const PoseObjectFromCamera& T_predicted, RobustScale scale,
                             int iterations) const noexcept {
    Result result;
    result.T_oc = T_start;
    Correspondences matched;
    for (int i = 0; i < iterations; ++i, scale = scale.Halved()) {
      const NormalEquations equations =
          Linearise(field, model_edges, config, T_predicted, scale, result, matched);
      Vec6 xi;
      if (equations.inliers < kFewestInliers || !equations.Solve(config.damping, xi)) {
        result.solved = false;
        return result;
      }
      result.T_oc = Step(xi, result.center_m, result.T_oc);
      result.iterations = i + 1;
      result.solved = true;
      // Near the end the points hardly move: they keep the surface that they were matched with.
      matched.known = i + 1 >= kSearches && scale.surface_m < kSettledScale_m &&
                      xi.template head<3>().norm() < kSettled_m &&
                      xi.template tail<3>().norm() < kSettled_rad;
      if (i + 1 >= kFewestSteps && xi.template head<3>().norm() < kConverged_m &&
          xi.template tail<3>().norm() < kConverged_rad) {
        break;
      }
    }
    return result;
  }

 private:
  static constexpr int kFewestInliers = 12;
  static constexpr int kFewestSteps = 5;
  static constexpr int kSearches = 2;
  static constexpr float kSettledScale_m = 0.003F;
  static constexpr float kSettled_m = 5e-4F;
  static constexpr float kSettled_rad = 5e-3F;
  static constexpr float kConverged_m = 1e-5F;
  static constexpr float kConverged_rad = 1e-4F;

  /// What the samples and edges were matched with in the last search.
  struct Correspondences {
    bool known = false;
    struct Surface {
      Handle cluster;
      float beyond_variance_m2;
    };
    std::array<Surface, static_cast<std::size_t>(Limits::kMaxRegistrationPoints)> surfaces;
    std::array<const typename Model::Edge*, static_cast<std::size_t>(Limits::kMaxEdgePoints)> edges;
  };

  /// Variance that is added to all residuals while the kernel is wide: as long as the pose is off
  /// by more than the noise, a few very precise samples must not outvote all others.
  [[nodiscard]] static float Blur(float scale_m) noexcept {
    constexpr float kShare = 0.1F;
    return kShare * kShare * scale_m * scale_m;
  }

  /// How far the edges of a frame are believed: edges that were seen for the first time agree with
  /// wrong ones here and there, and can shift a face that nothing else holds.
  [[nodiscard]] float EdgeTrust(float expected_share, int agreeing) const noexcept {
    const float expected = expected_share * static_cast<float>(edges_->size());
    const auto found = static_cast<float>(agreeing);
    return found < expected ? found * found / (expected * expected) : 1.0F;
  }

  /// T <- exp(xi) T, with the rotation about a centre instead of the origin: better conditioned in
  /// float.
  [[nodiscard]] static PoseObjectFromCamera Step(const Vec6& xi, const Vec3& center_m,
                                                 const PoseObjectFromCamera& T_oc) noexcept {
    const Vec3 theta = xi.tail<3>();
    const Mat3 turn = ExpSo3(theta);
    return PoseObjectFromCamera(
               Mat3(turn * T_oc.rotation()),
               Vec3(turn * (T_oc.translation() - center_m) + center_m + xi.head<3>()))
        .Normalized();
  }

  [[nodiscard]] NormalEquations Linearise(const Field& field, const Model& model_edges,
                                          const RegistrationConfig& config,
                                          const PoseObjectFromCamera& T_predicted,
                                          const RobustScale& scale, Result& result,
                                          Correspondences& matched) const noexcept {
    NormalEquations equations;
    result.center_m = result.T_oc * center_c_;
    result.unmatched = result.truncated = result.normal_mismatch = 0;
    for (int i = 0; i < samples_.size(); ++i)
      AddSample(field, config, i, scale.surface_m, result, matched, equations);
    result.information.across = equations.Isotropic() - equations.h;
    for (int i = 0; i < edges_->size(); ++i)
      AddEdge(model_edges, config, i, scale.edges_m, result, matched, equations);
    result.information.total = equations.h;
    result.inliers = equations.inliers;
    result.edge_inliers = equations.edge_inliers;
    result.edge_trust = EdgeTrust(config.edge_agreement, equations.edge_inliers);
    result.generation = equations.generation_sum / std::fmax(equations.weight_sum, 1e-9F);
    result.rms_m =
        std::sqrt(equations.weighted_square_sum / std::fmax(equations.weight_sum, 1e-9F));

    Vec6 deviation;  // from the predicted pose, about the same centre
    deviation.head<3>() = result.center_m - T_predicted * center_c_;
    deviation.tail<3>() = LogSo3(Mat3(result.T_oc.rotation() * T_predicted.rotation().transpose()));
    equations.AddPrior(deviation, config.temporal_std_m, config.temporal_std_rad);
    return equations;
  }

  void AddSample(const Field& field, const RegistrationConfig& config, int index, float scale_m,
                 Result& result, Correspondences& matched,
                 NormalEquations& equations) const noexcept {
    const SurfaceSample& sample = samples_[index];
    const Vec3 x_o = result.T_oc * sample.position_m;
    const Vec3 n_o = result.T_oc.rotation() * sample.normal;
    auto& known = matched.surfaces[static_cast<std::size_t>(index)];
    auto match =
        matched.known && known.cluster != kNoHandle
            ? field.Reuse(known.cluster, known.beyond_variance_m2, x_o)
            : field.FindMatch(x_o, n_o, config.match_radius_m + scale_m, config.min_normal_cos);
    known = {match.cluster, match.beyond_variance_m2};
    if (!match.found) {
      if (match.normal_mismatch) {
        ++result.normal_mismatch;
        return;
      }
      // Far from any local GP: let the coarse levels of the octree pull while the kernel is wide.
      if (scale_m > kCoarseScale_m) match = field.FindCoarseMatch(x_o, n_o, config.min_normal_cos);
      if (!match.found) {
        ++result.unmatched;
        return;
      }
    }
    if (std::abs(match.distance_m) > config.truncation_m) {  // residual truncation
      ++result.truncated;
      return;
    }
    const float norm = match.gradient.norm();
    if (norm < config.min_gradient_norm) {
      ++result.unmatched;
      return;
    }
    // d / |grad d| is the distance to first order; |grad d| < 1 tells how little is known: the
    // gradient weighting.
    const float residual_m = match.distance_m / norm;
    const float variance_m2 = sample.variance_m2 + match.variance_m2;
    const float sigma_m = std::sqrt(variance_m2);
    const float robust =
        GemanMcClure(residual_m, std::fmax(scale_m, config.robust_scale_sigmas * sigma_m));
    const float weight = robust * std::fmin(norm, 1.0F) / (variance_m2 + Blur(scale_m));
    equations.Add(x_o - result.center_m, match.gradient / norm, residual_m, weight);
    equations.AddMoments(x_o - result.center_m, weight);
    equations.weighted_square_sum += robust * residual_m * residual_m;
    equations.weight_sum += robust;
    equations.generation_sum += robust * match.generation;
    if (robust > 0.25F) ++equations.inliers;
  }

  void AddEdge(const Model& model_edges, const RegistrationConfig& config, int index, float scale_m,
               const Result& result, Correspondences& matched,
               NormalEquations& equations) const noexcept {
    auto& known = matched.edges[static_cast<std::size_t>(index)];
    if (matched.known && known == nullptr) return;
    const auto edge = FindEdge(model_edges, config.edge_std_px, (*edges_)[index], result.T_oc,
                               config.match_radius_m + scale_m, matched.known ? known : nullptr);
    known = edge.edge;
    if (!edge.found) return;
    const float robust = GemanMcClure(
        edge.residual_m, std::fmax(scale_m, config.robust_scale_sigmas * edge.sigma_m));
    equations.Add(edge.position_m - result.center_m, edge.gradient, edge.residual_m,
                  result.edge_trust * robust / (edge.sigma_m * edge.sigma_m + Blur(scale_m)));
    if (robust > 0.25F) ++equations.edge_inliers;
  }

  static constexpr float kCoarseScale_m = 0.002F;
  Samples samples_;
  Vec3 center_c_ = Vec3::Zero();
  const Edges* edges_ = nullptr;
};

}  // namespace disflow
