// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/types.h"

namespace disflow {

/// The linearised problem of one closed-form step (section V-D): H = sum w J^T J, b = sum w J^T d,
/// solved for H xi = -b.
struct NormalEquations {
  Mat6 h = Mat6::Zero();
  Vec6 b = Vec6::Zero();
  /// Moments of the residuals' weights about the centre of rotation.
  float moment_0 = 0.0F;
  Vec3 moment_1_m = Vec3::Zero();
  Mat3 moment_2_m2 = Mat3::Zero();

  /// Adds a residual with the Jacobian of section V-D, J(x) = [grad d^T, (x cross grad d)^T].
  /// @param lever_m The point relative to the centre of rotation.
  /// @param gradient Derivative of the residual by the point's position, object frame.
  void Add(const Vec3& lever_m, const Vec3& gradient, float residual_m, float weight) noexcept;
  void AddMoments(const Vec3& lever_m, float weight) noexcept;

  /// sum w J^T J if the gradients pointed everywhere at once: that of an isotropic residual.
  [[nodiscard]] Mat6 Isotropic() const noexcept;

  /// The temporal regulariser |xi - v'|^2_W (section V-E), as deviation from the predicted pose.
  void AddPrior(const Vec6& deviation, float std_m, float std_rad) noexcept;

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
