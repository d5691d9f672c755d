// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "disflow/geometry/transform.h"
#include "random_motion.h"

namespace disflow::testing {
namespace {

/// d log(exp(xi + d) exp(xi)^-1) / dd at d = 0, by central differences.
Mat6d NumericLeftJacobian(const Vec6d& xi) {
  constexpr double kStep = 1e-5;
  Mat6d jacobian;
  for (int i = 0; i < 6; ++i) {
    const Vec6d step = kStep * Vec6d::Unit(i);
    const MotionBA inverse = MotionAB::Exp(xi).Inverse();
    const Vec6d forward = (MotionAB::Exp(xi + step) * inverse).Log();
    const Vec6d backward = (MotionAB::Exp(xi - step) * inverse).Log();
    jacobian.col(i) = (forward - backward) / (2.0 * kStep);
  }
  return jacobian;
}

/// d log(exp(d) exp(xi)) / dd at d = 0.
Mat6d NumericLeftJacobianInverse(const Vec6d& xi) {
  constexpr double kStep = 1e-5;
  Mat6d jacobian;
  for (int i = 0; i < 6; ++i) {
    const Vec6d step = kStep * Vec6d::Unit(i);
    const MotionAB motion = MotionAB::Exp(xi);
    using Left = Transform<FrameA, FrameA, double>;
    jacobian.col(i) =
        ((Left::Exp(step) * motion).Log() - (Left::Exp(-step) * motion).Log()) / (2.0 * kStep);
  }
  return jacobian;
}

/// The angles lie on both sides of every switch between series and quotient.
class Se3JacobianAtAngle : public ::testing::TestWithParam<double> {};

TEST_P(Se3JacobianAtAngle, LeftJacobian_IsTheDerivativeOfExp) {
  RandomMotion random(21);
  for (int i = 0; i < 20; ++i) {
    const Vec6d xi = random.Twist(GetParam());
    EXPECT_LT((LeftJacobianSe3(xi) - NumericLeftJacobian(xi)).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_P(Se3JacobianAtAngle, LeftJacobianInverse_IsTheDerivativeOfLog) {
  RandomMotion random(22);
  for (int i = 0; i < 20; ++i) {
    const Vec6d xi = random.Twist(GetParam());
    const Mat6d error = LeftJacobianInverseSe3(xi) - NumericLeftJacobianInverse(xi);
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_P(Se3JacobianAtAngle, LeftJacobianTimesItsInverse_IsIdentity) {
  RandomMotion random(23);
  for (int i = 0; i < 20; ++i) {
    const Vec6d xi = random.Twist(GetParam());
    const Mat6d product = LeftJacobianSe3(xi) * LeftJacobianInverseSe3(xi);
    EXPECT_LT((product - Mat6d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST_P(Se3JacobianAtAngle, SinglePrecision_FollowsDoublePrecision) {
  RandomMotion random(24);
  for (int i = 0; i < 20; ++i) {
    const Vec6 xi = random.Twist(GetParam()).cast<float>();
    const Vec6d exact = xi.cast<double>();
    EXPECT_LT((LeftJacobianSe3(xi).cast<double>() - LeftJacobianSe3(exact)).norm(), 2e-5);
    EXPECT_LT((LeftJacobianInverseSe3(xi).cast<double>() - LeftJacobianInverseSe3(exact)).norm(),
              2e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, Se3JacobianAtAngle,
                         ::testing::Values(0.0, 1e-6, 0.0099, 0.0101, 0.0999, 0.1001, 0.1999,
                                           0.2001, 1.0, 2.5, 3.0),
                         [](const auto& angle) { return "Case" + std::to_string(angle.index); });

TEST(Se3Jacobian, NoRotation_LeavesTheSkewOfTheTranslation) {
  const Vec6d xi = (Vec6d() << 1.0, 2.0, 3.0, 0.0, 0.0, 0.0).finished();
  Mat6d expected = Mat6d::Identity();
  expected.topRightCorner<3, 3>() = 0.5 * Skew<double>(xi.head<3>());
  EXPECT_LT((LeftJacobianSe3(xi) - expected).norm(), 1e-15);
}

TEST(Skew, IsTheCrossProduct) {
  const Vec3 a(1.0F, -2.0F, 0.5F);
  const Vec3 b(0.3F, 4.0F, -1.0F);
  EXPECT_LT((Skew(a) * b - a.cross(b)).norm(), 1e-6F);
}

}  // namespace
}  // namespace disflow::testing
