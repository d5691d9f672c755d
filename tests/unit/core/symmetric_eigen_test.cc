// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/geometry/symmetric_eigen.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "symmetric_matrix.h"

namespace disflow {
namespace {

TEST(SymmetricEigen6, Decomposition_GivesTheMatrixBack) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Mat6 a = testing::RandomPositiveDefinite(seed);
    const SymmetricEigen6 eigen(a);
    const Mat6 back = eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose();
    EXPECT_LT((back - a).norm(), 1e-5F * a.norm());
    const Mat6 gram = eigen.vectors.transpose() * eigen.vectors;
    EXPECT_LT((gram - Mat6::Identity()).norm(), 1e-5F);
  }
}

TEST(SymmetricEigen6, ValuesOfVeryDifferentSize_AreAllFound) {
  const SymmetricEigen6 basis(testing::RandomPositiveDefinite(7));
  Vec6 values;
  values << 1e-3F, 1.0F, 3.0F, 1e2F, 1e3F, 0.0F;
  const Mat6 a = basis.vectors * values.asDiagonal() * basis.vectors.transpose();
  const SymmetricEigen6 eigen(0.5F * (a + a.transpose()));
  Vec6 found = eigen.values;
  std::sort(found.begin(), found.end());
  std::sort(values.begin(), values.end());
  EXPECT_LT((found - values).cwiseAbs().maxCoeff(), 1e-3F);
  EXPECT_NEAR(found[5], 1e3F, 0.1F);
}

TEST(SymmetricEigen6, DiagonalMatrix_IsLeftAsItIs) {
  Vec6 values;
  values << 5.0F, 3.0F, 0.0F, 2.0F, 2.0F, 9.0F;
  const SymmetricEigen6 eigen(values.asDiagonal());
  EXPECT_EQ(eigen.values, values);
  EXPECT_EQ(eigen.vectors, Mat6(Mat6::Identity()));
}

}  // namespace
}  // namespace disflow
