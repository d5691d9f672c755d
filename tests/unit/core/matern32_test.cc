// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/matern32.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <utility>
#include <vector>

namespace disflow {
namespace {

using Vec3d = Mat<double, 3>;

constexpr float kAmplitudeSquared = 0.0625F;

/// The kernel's definition; all derivatives below are taken of it by differences.
double Kernel(const Vec3d& p, const Vec3d& q) {
  const double r = (p - q).norm();
  return static_cast<double>(kAmplitudeSquared) * (1.0 + r) * std::exp(-r);
}

std::vector<std::pair<Vec3, Vec3>> PointPairs() {
  const Vec3 p(0.2F, -0.1F, 0.4F);
  return {{p, p + Vec3(0.3F, 0.2F, -0.1F)},
          {p, p + Vec3(0.0F, 0.0F, 0.05F)},
          {p, p + Vec3(-1.5F, 0.7F, 2.0F)},
          {p, p + Vec3(0.02F, 0.0F, 0.0F)},
          {p, p + Vec3(6.0F, -5.0F, 4.0F)}};
}

TEST(Matern32, ValueValue_IsTheKernel) {
  for (const auto& [p, q] : PointPairs()) {
    const double exact = Kernel(p.cast<double>(), q.cast<double>());
    EXPECT_NEAR(Matern32Block::At(p, q, kAmplitudeSquared).ValueValue(), exact, 1e-7);
  }
}

TEST(Matern32, ValueGradient_IsItsDerivativeBySecondPoint) {
  constexpr double kStep = 1e-5;
  for (const auto& [p, q] : PointPairs()) {
    const Vec3 gradient = Matern32Block::At(p, q, kAmplitudeSquared).ValueGradient();
    for (int i = 0; i < 3; ++i) {
      const Vec3d step = kStep * Vec3d::Unit(i);
      const double difference = Kernel(p.cast<double>(), q.cast<double>() + step) -
                                Kernel(p.cast<double>(), q.cast<double>() - step);
      EXPECT_NEAR(static_cast<double>(gradient(i)), difference / (2.0 * kStep), 1e-7);
    }
  }
}

TEST(Matern32, GradientGradient_IsItsMixedSecondDerivative) {
  constexpr double kStep = 1e-4;
  for (const auto& [p, q] : PointPairs()) {
    const Mat3 block = Matern32Block::At(p, q, kAmplitudeSquared).GradientGradient();
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Vec3d dp = kStep * Vec3d::Unit(i);
        const Vec3d dq = kStep * Vec3d::Unit(j);
        const Vec3d a = p.cast<double>();
        const Vec3d b = q.cast<double>();
        const double difference = Kernel(a + dp, b + dq) - Kernel(a + dp, b - dq) -
                                  Kernel(a - dp, b + dq) + Kernel(a - dp, b - dq);
        EXPECT_NEAR(static_cast<double>(block(i, j)), difference / (4.0 * kStep * kStep), 1e-6);
      }
    }
  }
}

TEST(Matern32, SamePoint_LeavesThePriorVariances) {
  const Vec3 p(0.3F, 0.4F, 0.5F);
  const auto block = Matern32Block::At(p, p, kAmplitudeSquared);
  EXPECT_FLOAT_EQ(block.ValueValue(), kAmplitudeSquared);
  EXPECT_EQ(block.ValueGradient(), Vec3(Vec3::Zero()));
  EXPECT_EQ(block.GradientGradient(), Mat3(kAmplitudeSquared * Mat3::Identity()));
}

TEST(Matern32, NearlySamePoint_TendsToThePrior) {
  const Vec3 p = Vec3::Zero();
  for (const float r : {1e-8F, 1e-7F, 1e-6F, 2e-6F, 1e-5F}) {
    const Vec3 q = r * Vec3(1.0F, 2.0F, -2.0F) / 3.0F;
    const Mat3 block = Matern32Block::At(p, q, kAmplitudeSquared).GradientGradient();
    const Mat3 error = block - kAmplitudeSquared * Mat3::Identity();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 3.0F * kAmplitudeSquared * (r + 1e-7F)) << r;
  }
}

TEST(Matern32, SwappedPoints_TransposeTheBlock) {
  for (const auto& [p, q] : PointPairs()) {
    const auto there = Matern32Block::At(p, q, kAmplitudeSquared);
    const auto back = Matern32Block::At(q, p, kAmplitudeSquared);
    EXPECT_EQ(there.ValueValue(), back.ValueValue());
    EXPECT_EQ(there.ValueGradient(), Vec3(-back.ValueGradient()));
    const Mat3 error = there.GradientGradient() - back.GradientGradient().transpose();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-7F * kAmplitudeSquared);
  }
}

TEST(Matern32, JointCovarianceOfManyPoints_IsPositiveSemidefinite) {
  constexpr int kPoints = 12;
  Eigen::MatrixXd joint(4 * kPoints, 4 * kPoints);
  const auto point = [](int i) {
    const auto t = static_cast<float>(i);
    return Vec3(0.3F * std::cos(2.4F * t), 0.3F * std::sin(2.4F * t), 0.02F * t);
  };
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      const auto block = Matern32Block::At(point(i), point(j), kAmplitudeSquared);
      joint(4 * i, 4 * j) = static_cast<double>(block.ValueValue());
      joint.block<1, 3>(4 * i, 4 * j + 1) = block.ValueGradient().cast<double>().transpose();
      joint.block<3, 1>(4 * i + 1, 4 * j) = -block.ValueGradient().cast<double>();
      joint.block<3, 3>(4 * i + 1, 4 * j + 1) = block.GradientGradient().cast<double>();
    }
  }
  EXPECT_LT((joint - joint.transpose()).norm(), 1e-6 * joint.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(joint);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-7);
}

}  // namespace
}  // namespace disflow
