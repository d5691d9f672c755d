// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Cholesky>

#include "disflow/types.h"

namespace disflow {

/// Solves A x = b for a symmetric positive definite 6x6 matrix. Right-hand sides are taken one by
/// one: Eigen's solve for several at once refers to malloc even at fixed sizes.
class SymmetricSolver6 {
 public:
  explicit SymmetricSolver6(const Mat6& a) noexcept : ldlt_(a) {}

  /// @return false when A is not positive definite (NaN included); solutions are then meaningless.
  [[nodiscard]] bool ok() const noexcept {
    return ldlt_.info() == Eigen::Success && (ldlt_.vectorD().array() > 0.0F).all();
  }
  [[nodiscard]] Vec6 Solve(const Vec6& b) const noexcept { return ldlt_.solve(b); }
  [[nodiscard]] Mat6 Solve(const Mat6& b) const noexcept {
    Mat6 x;
    for (int column = 0; column < 6; ++column) x.col(column) = Solve(Vec6(b.col(column)));
    return x;
  }
  [[nodiscard]] Mat6 Inverse() const noexcept { return Solve(Mat6(Mat6::Identity())); }

 private:
  Eigen::LDLT<Mat6> ldlt_;
};

}  // namespace disflow
