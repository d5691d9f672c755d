// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "disflow/config.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/field/distance_field.h"
#include "disflow/field/edge_map.h"
#include "disflow/flow/edge_residual.h"
#include "disflow/flow/kernel_width.h"
#include "disflow/flow/normal_equations.h"
#include "disflow/flow/registration_result.h"
#include "disflow/flow/surface_residual.h"

namespace disflow {

/// Registers observed samples to the distance field (sections V-C to V-E).
///
/// Additions to the paper: weights 1/sigma^2 with a robust kernel whose width shrinks from step to
/// step (graduated non-convexity), gates on normal agreement and matching distance, rotation about
/// the observed centroid, occluding edges with the radius that they are rounded with.
///
/// Larger members are defined in registration_impl.h.
template <class Limits>
class Registration {
 public:
  using Field = DistanceField<Limits>;
  using Edges = typename EdgeResiduals<Limits>::Edges;
  using Model = EdgeMap<Limits::kMaxModelEdges>;
  using Samples = typename SurfaceResiduals<Limits>::Samples;
  using RobustScale = disflow::RobustScale;
  using Result = RegistrationResult;

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
  /// Whether edges that were found while the object may have slid are left out from now on.
  void UseKnownEdges(bool known_only) noexcept { known_edges_ = known_only; }
  /// How wide the surface's robust kernel ends from now on.
  void SetKernel(const KernelWidth& width) noexcept { surface_width_ = width; }
  /// The points to register.
  [[nodiscard]] const Samples& samples() const noexcept { return samples_; }
  /// The points' centroid, camera frame.
  [[nodiscard]] const Vec3& center_c() const noexcept { return center_c_; }

  /// Share of the observed points that the model explains under a pose, 0..1. Unmatched points
  /// count 0.
  [[nodiscard]] float Score(const Field& field, const RegistrationConfig& config,
                            const PoseObjectFromCamera& T_oc) const noexcept;

  /// The same under the pose that Align() found last, by what the points were matched with there.
  [[nodiscard]] float ScoreOfAligned(const Field& field, const RegistrationConfig& config,
                                     const PoseObjectFromCamera& T_oc) noexcept;

  /// Share of the observed occluding edges that lie on edges of the model, 0..1, of those that
  /// should. Tells apart poses between which the surface could slide.
  [[nodiscard]] float EdgeScore(const Model& model_edges, const RegistrationConfig& config,
                                const PoseObjectFromCamera& T_oc) noexcept;

  /// Minimises E = sum d(T_oc x^c)^2 (section V-C) by closed-form steps from T_start.
  /// @param T_predicted Centre of the temporal regulariser.
  /// @param scale Widths of the robust kernels at the first step, see RegistrationPace.
  [[nodiscard]] Result Align(const Field& field, const Model& model_edges,
                             const RegistrationConfig& config, const PoseObjectFromCamera& T_start,
                             const PoseObjectFromCamera& T_predicted, RobustScale scale,
                             StepLimit steps) noexcept;

  /// What the pose that Align() found last is told by what was not found while the object may have
  /// slid. Forgets what the points were matched with.
  [[nodiscard]] RegistrationInformation KnownInformation(const Field& field,
                                                         const Model& model_edges,
                                                         const RegistrationConfig& config,
                                                         Result result) noexcept;

 private:
  static constexpr int kMinInliers = 12;  ///< Twice the unknowns.
  /// Share of the squared tilt between normals and gradients that is the gradients': those of the
  /// model average 15 observations, of which a correlation of 0.7 from frame to frame leaves 3.
  static constexpr float kFieldsTilt = 0.25F;
  /// Of edges whose noise is known 95 % are within two standard deviations.
  static constexpr float kEdgeInlierReach = 2.0F;

  [[nodiscard]] static Mat6 OfEdgeErrors(EdgeResiduals<Limits>& edges,
                                         const RegistrationConfig& config, const RobustScale& scale,
                                         const Result& result) noexcept;

  /// One line per kind of residual.
  [[nodiscard]] NormalEquations Linearise(SurfaceResiduals<Limits>& surfaces,
                                          EdgeResiduals<Limits>& edges,
                                          const RegistrationConfig& config,
                                          const RobustScale& scale, Matching matching,
                                          Result& result) const noexcept;

  Samples samples_;
  KernelWidth surface_width_;
  bool known_edges_ = false;
  typename SurfaceResiduals<Limits>::Known known_;
  typename EdgeResiduals<Limits>::Index edge_index_;
  Vec3 center_c_ = Vec3::Zero();
  const Edges* edges_ = nullptr;
};

}  // namespace disflow
