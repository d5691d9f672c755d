// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/normal_equations.h"

#include "disflow/geometry/symmetric_solver.h"
#include "disflow/geometry/transform.h"

namespace disflow {

NormalEquations& NormalEquations::operator+=(const NormalSums& sums) noexcept {
  Mat<float, 8, 8> all;
  all.leftCols<4>() = sums.first_;
  all.topRightCorner<4, 4>() = sums.first_.bottomRows<4>().transpose();
  all.bottomRightCorner<4, 4>() = sums.second_;
  constexpr int kRadius = 6;
  constexpr int kResidual = 7;
  h += all.topLeftCorner<6, 6>();
  b += all.col(kResidual).head<6>();
  h_radius += all.col(kRadius).head<6>();
  h_radius_radius += all(kRadius, kRadius);
  b_radius += all(kRadius, kResidual);
  moment_0 += sums.moments_(3, 3);
  moment_1_m += sums.moments_.col(3).head<3>();
  moment_2_m2 += sums.moments_.topLeftCorner<3, 3>();
  return *this;
}

void NormalEquations::AddRadiusPrior(float deviation_m, float variance_m2) noexcept {
  h_radius_radius += 1.0F / variance_m2;
  b_radius += deviation_m / variance_m2;
}

NormalEquations NormalEquations::WithoutRadius() const noexcept {
  NormalEquations pose = *this;
  pose.h.noalias() -= h_radius * h_radius.transpose() / h_radius_radius;
  pose.b -= h_radius * (b_radius / h_radius_radius);
  return pose;
}

float NormalEquations::RadiusStep(const Vec6& xi) const noexcept {
  return -(b_radius + h_radius.dot(xi)) / h_radius_radius;
}

float NormalEquations::RadiusVariance(const NormalEquations& pose) const noexcept {
  const float variance_m2 = 1.0F / h_radius_radius;
  const SymmetricSolver6 solver(pose.h);
  if (!solver.ok()) return variance_m2;
  const Vec6 per_pose = h_radius / h_radius_radius;
  return variance_m2 + per_pose.dot(solver.Solve(per_pose));
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
