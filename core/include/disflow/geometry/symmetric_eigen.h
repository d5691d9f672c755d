// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Jacobi>

#include "disflow/types.h"

namespace disflow {

/// A = V diag(values) V^T of a symmetric 6x6 matrix by cyclic Jacobi rotations, a fixed number of
/// them, so that the time is known beforehand. Golub and Van Loan, "Matrix Computations", section
/// 8.5. (Eigen's own solver iterates until it converges.)
struct SymmetricEigen6 {
  Vec6 values;   ///< In no order.
  Mat6 vectors;  ///< Columns, orthonormal.

  explicit SymmetricEigen6(Mat6 a) noexcept : vectors(Mat6::Identity()) {
    // Convergence is quadratic; float's precision is reached after five.
    constexpr int kSweeps = 6;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (int p = 0; p < 5; ++p) {
        for (int q = p + 1; q < 6; ++q) {
          Eigen::JacobiRotation<float> rotation;
          if (!rotation.makeJacobi(a, p, q)) continue;
          a.applyOnTheLeft(p, q, rotation.adjoint());
          a.applyOnTheRight(p, q, rotation);
          vectors.applyOnTheRight(p, q, rotation);
        }
      }
    }
    values = a.diagonal();
  }
};

}  // namespace disflow
