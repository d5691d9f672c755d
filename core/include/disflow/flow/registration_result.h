// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/field/edge_rounding.h"
#include "disflow/flow/pose_uncertainty.h"
#include "disflow/geometry/transform.h"

/// @file
/// What registration works with and gives, whatever the profile.

namespace disflow {

/// Widths of the robust kernels. Edges of a view that were not seen before find others nearby, so
/// that theirs has to be narrow unless the pose is being searched for.
struct RobustScale {
  float surface_m = 0.0F;
  float edges_m = 0.0F;
};

/// How many steps a registration may take.
struct StepLimit {
  int most = 0;
  /// The start is a prediction that is believed: once a step moves it little, the kernels may
  /// narrow faster and the steps end early. What is searched for or has slid needs all of them.
  bool may_end_early = false;
};

/// What a registration found; the counts are those of its last step.
struct RegistrationResult {
  bool solved = false;
  PoseObjectFromCamera T_oc;
  RegistrationInformation information;  ///< At the end, about center_m, object frame.
  Vec3 center_m = Vec3::Zero();         ///< Centre of rotation, object frame.
  Vec3 center_c = Vec3::Zero();         ///< The same, the points' centroid, camera frame.
  EdgeRounding rounding;                ///< What is known of the object's edges by this frame.
  int iterations = 0;
  int points = 0;  ///< That were registered.
  int inliers = 0;
  int edge_inliers = 0;
  /// How far samples and edges are off, in their standard deviations; 0 if that is not known.
  float spread = 0.0F;
  float edge_spread = 0.0F;
  float edge_trust = 1.0F;  ///< How far edges are believed, 0..1: as far as they agree.
  float rms_m = 0.0F;
  float std_m = 0.0F;       ///< What the residuals are known to scatter by, see ResidualSums.
  float generation = 0.0F;  ///< Mean over the surface that was registered to, see Cluster.
  int unmatched = 0;
  int truncated = 0;
  int normal_mismatch = 0;
  /// In its place, by what was not found while the object may have slid.
  bool held_by_known = false;
  bool shifted = false;  ///< To where what nothing held was found, see ShiftSearch.
  bool turned = false;   ///< About an axis about which nothing held it, see TurnSearch.
};

/// How far a distance from the model is what is to be expected, 0..1.
[[nodiscard]] inline float Explained(float distance_m, float variance_m2) noexcept {
  constexpr float kTolerance_m = 0.003F;
  const float expected_m2 = kTolerance_m * kTolerance_m + variance_m2;
  return expected_m2 / (expected_m2 + distance_m * distance_m);
}

/// How far the edges of a frame are believed, 0..1: edges that were seen for the first time agree
/// with wrong ones here and there, and can shift a face that nothing else holds.
/// @param expected_share RegistrationConfig::edge_agreement.
/// @param agreeing How many of the `edges` that should agree with the model's do.
[[nodiscard]] float EdgeTrust(float expected_share, int edges, int agreeing) noexcept;

/// T <- exp(xi) T of section V-D, with the rotation about a centre instead of the origin: better
/// conditioned in float.
/// @param center_m Object frame.
[[nodiscard]] PoseObjectFromCamera StepAbout(const Vec3& center_m, const Vec6& xi,
                                             const PoseObjectFromCamera& T_oc) noexcept;

/// The step about the same centre that leads from one pose to another.
/// @param center_c The centre, camera frame.
[[nodiscard]] Vec6 DeviationAbout(const Vec3& center_c, const PoseObjectFromCamera& T_oc,
                                  const PoseObjectFromCamera& T_from) noexcept;

}  // namespace disflow
