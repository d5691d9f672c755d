// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/normal_equations.h"

#include "disflow/geometry/symmetric_solver.h"
#include "disflow/geometry/transform.h"

namespace disflow {

void NormalEquations::Add(const Vec3& lever_m, const Vec3& gradient, float residual_m,
                          float weight) noexcept {
  Vec6 j;
  j.head<3>() = gradient;
  j.tail<3>() = lever_m.cross(gradient);
  h.noalias() += weight * j * j.transpose();
  b.noalias() += (weight * residual_m) * j;
}

void NormalEquations::AddMoments(const Vec3& lever_m, float weight) noexcept {
  moment_0 += weight;
  moment_1_m += weight * lever_m;
  moment_2_m2 += weight * lever_m * lever_m.transpose();
}

Mat6 NormalEquations::Isotropic() const noexcept {
  const Mat3 lever = Skew(moment_1_m);
  Mat6 result;
  result.topLeftCorner<3, 3>() = moment_0 * Mat3::Identity();
  result.bottomLeftCorner<3, 3>() = lever;
  result.topRightCorner<3, 3>() = -lever;
  result.bottomRightCorner<3, 3>() = moment_2_m2.trace() * Mat3::Identity() - moment_2_m2;
  return result;
}

void NormalEquations::AddPrior(const Vec6& deviation, float std_m, float std_rad) noexcept {
  Vec6 information;
  information << Vec3::Constant(1.0F / (std_m * std_m)), Vec3::Constant(1.0F / (std_rad * std_rad));
  h.diagonal() += information;
  b += information.cwiseProduct(deviation);
}

bool NormalEquations::Solve(float damping, Vec6& xi) const noexcept {
  Mat6 damped = h;
  damped.diagonal() *= 1.0F + damping;
  const SymmetricSolver6 solver(damped);
  if (!solver.ok()) return false;
  xi = -solver.Solve(b);
  return xi.allFinite();
}

}  // namespace disflow
