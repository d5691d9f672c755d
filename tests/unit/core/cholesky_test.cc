// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <random>
#include <vector>

namespace disflow {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd RandomPositiveDefinite(int size, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  MatrixXd root(size, size);
  for (int i = 0; i < size * size; ++i) root(i / size, i % size) = normal(random);
  const MatrixXd a = root * root.transpose() + 0.1 * size * MatrixXd::Identity(size, size);
  return a.cast<float>().cast<double>();
}

/// Column-major storage with a stride; NaN wherever the factorisation must not look.
std::vector<float> LowerTriangle(const MatrixXd& a, int stride) {
  std::vector<float> storage(static_cast<std::size_t>(stride * stride),
                             std::numeric_limits<float>::quiet_NaN());
  for (int column = 0; column < a.cols(); ++column) {
    for (int row = column; row < a.rows(); ++row)
      storage[static_cast<std::size_t>(column * stride + row)] = static_cast<float>(a(row, column));
  }
  return storage;
}

/// Sizes around the unrolling by four, with and without padding.
class CholeskyOfSize : public ::testing::TestWithParam<int> {
 protected:
  int size_ = GetParam();
  int stride_ = GetParam() + 3;
  MatrixXd a_ = RandomPositiveDefinite(size_, 7);
  std::vector<float> l_ = LowerTriangle(a_, stride_);
};

TEST_P(CholeskyOfSize, Factor_GivesTheMatrixBack) {
  ASSERT_TRUE(CholeskyFactorise(l_.data(), size_, stride_));
  MatrixXd l = MatrixXd::Zero(size_, size_);
  for (int column = 0; column < size_; ++column) {
    for (int row = column; row < size_; ++row) {
      const auto value = static_cast<double>(l_[static_cast<std::size_t>(column * stride_ + row)]);
      l(row, column) = row == column ? 1.0 / value : value;
    }
  }
  EXPECT_LT((l * l.transpose() - a_).norm(), 1e-6 * a_.norm());
}

TEST_P(CholeskyOfSize, BothTriangularSolves_SolveTheSystem) {
  ASSERT_TRUE(CholeskyFactorise(l_.data(), size_, stride_));
  std::vector<float> x(static_cast<std::size_t>(size_));
  VectorXd b(size_);
  for (int i = 0; i < size_; ++i) {
    x[static_cast<std::size_t>(i)] = static_cast<float>(i % 5) - 2.0F;
    b(i) = static_cast<double>(x[static_cast<std::size_t>(i)]);
  }
  CholeskySolveLower(l_.data(), size_, stride_, x.data());
  CholeskySolveUpper(l_.data(), size_, stride_, x.data());
  const VectorXd exact = a_.ldlt().solve(b);
  for (int i = 0; i < size_; ++i) {
    EXPECT_NEAR(static_cast<double>(x[static_cast<std::size_t>(i)]), exact(i),
                2e-6 * (exact.norm() + 1.0));
  }
}

TEST_P(CholeskyOfSize, NegativeDirection_IsRefused) {
  // Positive diagonal, but indefinite: the last pivot turns negative.
  if (size_ == 1) return;
  a_(size_ - 1, 0) = a_(0, size_ - 1) = 2.0 * std::sqrt(a_(0, 0) * a_(size_ - 1, size_ - 1));
  l_ = LowerTriangle(a_, stride_);
  EXPECT_FALSE(CholeskyFactorise(l_.data(), size_, stride_));
}

TEST_P(CholeskyOfSize, DoubledRow_IsRefused) {
  if (size_ == 1) return;
  a_.col(size_ - 1) = a_.col(0);
  a_.row(size_ - 1) = a_.row(0);
  l_ = LowerTriangle(a_, stride_);
  EXPECT_FALSE(CholeskyFactorise(l_.data(), size_, stride_));
}

TEST_P(CholeskyOfSize, NotFinite_IsRefusedWhereverItIs) {
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    for (int column = 0; column < size_; ++column) {
      std::vector<float> l = LowerTriangle(a_, stride_);
      l[static_cast<std::size_t>(column * stride_ + size_ - 1)] = bad;
      EXPECT_FALSE(CholeskyFactorise(l.data(), size_, stride_)) << column;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, CholeskyOfSize, ::testing::Values(1, 2, 3, 4, 5, 7, 8, 31, 48, 64),
                         ::testing::PrintToStringParamName());

TEST(Cholesky, Zero_IsRefused) {
  float zero = 0.0F;
  EXPECT_FALSE(CholeskyFactorise(&zero, 1, 1));
}

TEST(Cholesky, NegativeDiagonal_IsRefused) {
  float negative = -1.0F;
  EXPECT_FALSE(CholeskyFactorise(&negative, 1, 1));
}

}  // namespace
}  // namespace disflow
