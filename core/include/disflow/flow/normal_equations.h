// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "disflow/geometry/symmetric_solver.h"
#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// The linearised problem of one closed-form step (section V-C): H = sum w J^T J, b = sum w J^T r,
/// solved for H xi = -b.
struct NormalEquations {
  Mat6 h = Mat6::Zero();
  Vec6 b = Vec6::Zero();
  int inliers = 0;
  int edge_inliers = 0;
  float weighted_square_sum = 0.0F;
  float weight_sum = 0.0F;
  float generation_sum = 0.0F;
  /// Moments of the samples' weights about the centre of rotation.
  float moment_0 = 0.0F;
  Vec3 moment_1_m = Vec3::Zero();
  Mat3 moment_2_m2 = Mat3::Zero();

  /// @param lever_m The point relative to the centre of rotation.
  /// @param gradient Derivative of the residual by the point's position, object frame.
  void Add(const Vec3& lever_m, const Vec3& gradient, float residual_m, float weight) noexcept {
    Vec6 j;  // J(x) = [grad d^T, (x cross grad d)^T]
    j.head<3>() = gradient;
    j.tail<3>() = lever_m.cross(gradient);
    h.noalias() += weight * j * j.transpose();
    b.noalias() += (weight * residual_m) * j;
  }

  void AddMoments(const Vec3& lever_m, float weight) noexcept {
    moment_0 += weight;
    moment_1_m += weight * lever_m;
    moment_2_m2 += weight * lever_m * lever_m.transpose();
  }

  /// sum w J^T J if the gradients pointed everywhere at once: that of an isotropic residual.
  [[nodiscard]] Mat6 Isotropic() const noexcept {
    const Mat3 lever = Skew(moment_1_m);
    Mat6 result;
    result.topLeftCorner<3, 3>() = moment_0 * Mat3::Identity();
    result.bottomLeftCorner<3, 3>() = lever;
    result.topRightCorner<3, 3>() = -lever;
    result.bottomRightCorner<3, 3>() = moment_2_m2.trace() * Mat3::Identity() - moment_2_m2;
    return result;
  }

  /// The temporal regulariser |xi - Ad v|^2_W (section V-D), as deviation from the predicted pose.
  void AddPrior(const Vec6& deviation, float std_m, float std_rad) noexcept {
    Vec6 information;
    information << Vec3::Constant(1.0F / (std_m * std_m)),
        Vec3::Constant(1.0F / (std_rad * std_rad));
    h.diagonal() += information;
    b += information.cwiseProduct(deviation);
  }

  /// xi = -(H + damping diag(H))^-1 b. @return false when the system cannot be solved.
  [[nodiscard]] bool Solve(float damping, Vec6& xi) const noexcept {
    Mat6 damped = h;
    damped.diagonal() *= 1.0F + damping;
    const SymmetricSolver6 solver(damped);
    if (!solver.ok()) return false;
    xi = -solver.Solve(b);
    return xi.allFinite();
  }
};

/// Weight of the Geman-McClure kernel: 1 for small residuals, falling as r^-4.
[[nodiscard]] inline float GemanMcClure(float residual, float scale) noexcept {
  const float s2 = scale * scale;
  const float w = s2 / (s2 + residual * residual);
  return w * w;
}

}  // namespace disflow
