// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/gp_kernel.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace disflow {
namespace {

using Vec3d = Mat<double, 3>;

constexpr float kAmplitude = 0.25F;
constexpr float kAmplitudeSquared = kAmplitude * kAmplitude;
const GpKernel kKernel({0.06F, kAmplitude});

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

TEST(GpKernel, ValueValue_IsTheKernel) {
  for (const auto& [p, q] : PointPairs()) {
    const double exact = Kernel(p.cast<double>(), q.cast<double>());
    EXPECT_NEAR(kKernel.Covariance(p, q)(0, 0), exact, 1e-7);
  }
}

TEST(GpKernel, ValueGradient_IsItsDerivativeBySecondPoint) {
  constexpr double kStep = 1e-5;
  for (const auto& [p, q] : PointPairs()) {
    const Vec3 gradient = kKernel.Covariance(p, q).block<1, 3>(0, 1).transpose();
    for (int i = 0; i < 3; ++i) {
      const Vec3d step = kStep * Vec3d::Unit(i);
      const double difference = Kernel(p.cast<double>(), q.cast<double>() + step) -
                                Kernel(p.cast<double>(), q.cast<double>() - step);
      EXPECT_NEAR(static_cast<double>(gradient(i)), difference / (2.0 * kStep), 1e-7);
    }
  }
}

TEST(GpKernel, GradientGradient_IsItsMixedSecondDerivative) {
  constexpr double kStep = 1e-4;
  for (const auto& [p, q] : PointPairs()) {
    const Mat3 block = kKernel.Covariance(p, q).block<3, 3>(1, 1);
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

TEST(GpKernel, SamePoint_LeavesThePriorVariances) {
  const Vec3 p(0.3F, 0.4F, 0.5F);
  EXPECT_EQ(kKernel.prior_variance(), kAmplitudeSquared);
  EXPECT_EQ(kKernel.Covariance(p, p), Mat4(kKernel.prior_variance() * Mat4::Identity()));
}

TEST(GpKernel, NearlySamePoint_TendsToThePrior) {
  const Vec3 p = Vec3::Zero();
  for (const float r : {1e-8F, 1e-7F, 1e-6F, 2e-6F, 1e-5F}) {
    const Vec3 q = r * Vec3(1.0F, 2.0F, -2.0F) / 3.0F;
    const Mat3 block = kKernel.Covariance(p, q).block<3, 3>(1, 1);
    const Mat3 error = block - kAmplitudeSquared * Mat3::Identity();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 3.0F * kAmplitudeSquared * (r + 1e-7F)) << r;
  }
}

TEST(GpKernel, SwappedPoints_TransposeTheBlock) {
  for (const auto& [p, q] : PointPairs()) {
    const Mat4 error = kKernel.Covariance(p, q) - kKernel.Covariance(q, p).transpose();
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-7F * kAmplitudeSquared);
  }
}

TEST(GpKernel, JointCovarianceOfManyPoints_IsPositiveSemidefinite) {
  constexpr int kPoints = 12;
  Eigen::MatrixXd joint(4 * kPoints, 4 * kPoints);
  const auto point = [](int i) {
    const auto t = static_cast<float>(i);
    return Vec3(0.3F * std::cos(2.4F * t), 0.3F * std::sin(2.4F * t), 0.02F * t);
  };
  for (int i = 0; i < kPoints; ++i) {
    for (int j = 0; j < kPoints; ++j) {
      joint.block<4, 4>(4 * i, 4 * j) = kKernel.Covariance(point(i), point(j)).cast<double>();
    }
  }
  EXPECT_LT((joint - joint.transpose()).norm(), 1e-6 * joint.norm());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(joint);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-7);
}

// The vectorised sum of a prediction and the joint covariance are two forms of one kernel.
TEST(GpKernel, PredictionFromManySamples_IsTheSumOfTheirCovariances) {
  constexpr int kSamples = 8;
  using Row = GpKernel::Row<kSamples>;
  Row ex, ey, ez;
  std::array<Row, 4> alpha;
  const Vec3 p(0.1F, -0.2F, 0.3F);
  Vec4 expected = Vec4::Zero();
  for (int i = 0; i < kSamples; ++i) {
    const auto t = static_cast<float>(i);
    const Vec3 e = i == 0 ? Vec3(Vec3::Zero())  // at a sample
                          : Vec3(0.4F * std::sin(t), 0.3F * std::cos(2.0F * t), 0.1F * t);
    const Vec4 weight(std::cos(t), std::sin(3.0F * t), 0.5F, std::cos(5.0F * t));
    ex[i] = e.x();
    ey[i] = e.y();
    ez[i] = e.z();
    for (int k = 0; k < 4; ++k) alpha[static_cast<std::size_t>(k)][i] = weight[k];
    expected += kKernel.Covariance(p, p - e) * weight;
  }
  float value = 0.0F;
  Vec3 gradient;
  kKernel.Predict<kSamples>(ex, ey, ez, alpha, value, gradient);
  EXPECT_NEAR(value, expected[0], 1e-5F * kSamples * kAmplitudeSquared);
  EXPECT_LT((gradient - expected.tail<3>()).norm(), 1e-5F * kSamples * kAmplitudeSquared);
}

}  // namespace
}  // namespace disflow
