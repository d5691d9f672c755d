// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/weak_direction.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace disflow {
namespace {

WeakDirection Largest(const Mat3& covariance, WeakKind kind) noexcept {
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(covariance);  // closed form: no iteration that might not end
  return {kind, solver.eigenvectors().col(2), std::sqrt(std::max(solver.eigenvalues()[2], 0.0F))};
}

}  // namespace

WeakDirection FindWeakDirection(const Mat6& covariance, const MonitorConfig& config) noexcept {
  if (!covariance.allFinite()) return {};
  const Mat3 position = covariance.topLeftCorner<3, 3>();
  const Mat3 rotation = covariance.bottomRightCorner<3, 3>();
  const WeakDirection along = Largest(position, WeakKind::kTranslation);
  const WeakDirection about = Largest(rotation, WeakKind::kRotation);
  const float excess_along = along.std / config.weak_std_m;
  const float excess_about = about.std / config.weak_std_rad;
  if (std::max(excess_along, excess_about) <= 1.0F) return {};
  return excess_about >= excess_along ? about : along;
}

}  // namespace disflow
