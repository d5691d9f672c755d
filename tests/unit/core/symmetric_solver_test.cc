// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/geometry/symmetric_solver.h"

#include <gtest/gtest.h>

#include <limits>

#include "symmetric_matrix.h"

namespace disflow {
namespace {

using testing::RandomPositiveDefinite;

TEST(SymmetricSolver6, Solution_SatisfiesTheSystem) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const Mat6 a = RandomPositiveDefinite(seed);
    const Vec6 b = RandomPositiveDefinite(seed + 100).col(2);
    const SymmetricSolver6 solver(a);
    ASSERT_TRUE(solver.ok());
    EXPECT_LT((a * solver.Solve(b) - b).norm(), 1e-4F * b.norm());
    EXPECT_LT((a * solver.Inverse() - Mat6::Identity()).norm(), 1e-3F);
  }
}

TEST(SymmetricSolver6, NotPositiveDefinite_IsRefused) {
  Mat6 a = Mat6::Identity();
  a(3, 3) = -1.0F;
  EXPECT_FALSE(SymmetricSolver6(a).ok());
  a(3, 3) = 0.0F;
  EXPECT_FALSE(SymmetricSolver6(a).ok());
  EXPECT_FALSE(SymmetricSolver6(Mat6::Zero()).ok());
}

TEST(SymmetricSolver6, NotFinite_IsRefused) {
  Mat6 a = Mat6::Identity();
  a(2, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(SymmetricSolver6(a).ok());
}

}  // namespace
}  // namespace disflow
