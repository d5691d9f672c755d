// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/types.h"

namespace disflow {

/// Sums over residuals, w r r^T of whole rows r = (J, per radius, residual): laid out for vector
/// instructions, since it is added to for every residual in every step.
class NormalSums {
 public:
  /// Adds a residual with the Jacobian of section V-D, J(x) = [grad d^T, (x cross grad d)^T].
  /// @param lever_m The point relative to the centre of rotation.
  /// @param gradient Derivative of the residual by the point's position, object frame.
  /// @param per_radius Its derivative by the radius of the edges.
  /// Defined in residual_sums_impl.h.
  void Add(const Vec3& lever_m, const Vec3& gradient, float residual_m, float weight,
           float per_radius = 0.0F) noexcept;

 private:
  friend struct NormalEquations;

  /// Of the first half of a row with all of it, and of the second half with itself.
  Mat<float, 8, 4> first_ = Mat<float, 8, 4>::Zero();
  Mat4 second_ = Mat4::Zero();
  Mat4 moments_ = Mat4::Zero();  ///< Of (lever, 1).
};

/// The linearised problem of one closed-form step (section V-D): H = sum w J^T J, b = sum w J^T d,
/// solved for H xi = -b. Beside the pose there is the radius that the object's edges are rounded
/// with (see EdgeRounding), an addition to the paper.
struct NormalEquations {
  Mat6 h = Mat6::Zero();
  Vec6 b = Vec6::Zero();
  Vec6 h_radius = Vec6::Zero();  ///< Pose and radius.
  float h_radius_radius = 0.0F;
  float b_radius = 0.0F;
  /// Moments of the residuals' weights about the centre of rotation.
  float moment_0 = 0.0F;
  Vec3 moment_1_m = Vec3::Zero();
  Mat3 moment_2_m2 = Mat3::Zero();

  NormalEquations& operator+=(const NormalSums& sums) noexcept;

  /// sum w J^T J if the gradients pointed everywhere at once: that of an isotropic residual.
  [[nodiscard]] Mat6 Isotropic() const noexcept;

  /// The temporal regulariser |xi - v'|^2_W (section V-E), as deviation from the predicted pose.
  void AddPrior(const Vec6& deviation, float std_m, float std_rad) noexcept;

  /// What was known of the radius before.
  /// @param deviation_m Of the present radius from that.
  void AddRadiusPrior(float deviation_m, float variance_m2) noexcept;
  /// The same problem with the radius solved for: what it says of the pose is what is known of the
  /// pose without knowing the radius (Schur complement).
  [[nodiscard]] NormalEquations WithoutRadius() const noexcept;
  /// The step of the radius that goes with a step of the pose.
  [[nodiscard]] float RadiusStep(const Vec6& xi) const noexcept;
  /// Variance of the radius.
  /// @param pose The same problem without the radius, with all that is known of the pose.
  [[nodiscard]] float RadiusVariance(const NormalEquations& pose) const noexcept;

  /// xi = -(H + damping diag(H))^-1 b, the damping of section V-E.
  /// @return false when the system cannot be solved.
  [[nodiscard]] bool Solve(float damping, Vec6& xi) const noexcept;
};

/// Weight of the Geman-McClure kernel: 1 for small residuals, falling as r^-4.
[[nodiscard]] inline float GemanMcClure(float residual, float scale) noexcept {
  const float s2 = scale * scale;
  const float w = s2 / (s2 + residual * residual);
  return w * w;
}

}  // namespace disflow
