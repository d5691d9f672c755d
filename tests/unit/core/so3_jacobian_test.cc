// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "disflow/geometry/transform.h"
#include "random_motion.h"

namespace disflow::testing {
namespace {

using Vec3d = Mat<double, 3>;
using Mat3d = Mat<double, 3, 3>;

/// A column for each axis of what a small turn changes, by central differences.
template <class Change>
Mat3d Derivative(const Change& change) {
  constexpr double kStep = 1e-5;
  Mat3d jacobian;
  for (int i = 0; i < 3; ++i) {
    const Vec3d step = kStep * Vec3d::Unit(i);
    jacobian.col(i) = (change(step) - change(Vec3d(-step))) / (2.0 * kStep);
  }
  return jacobian;
}

/// The angles lie on both sides of every switch between series and quotient.
class So3JacobianAtAngle : public ::testing::TestWithParam<double> {
 protected:
  [[nodiscard]] Vec3d AnyTurn() { return random_.Twist(GetParam()).tail<3>(); }

 private:
  RandomMotion random_{21};
};

TEST_P(So3JacobianAtAngle, LeftJacobian_IsTheDerivativeOfExp) {
  for (int i = 0; i < 20; ++i) {
    const Vec3d theta = AnyTurn();
    const Mat3d numeric = Derivative([&](const Vec3d& step) {
      return TurnBetween<double>(ExpSo3(theta), ExpSo3<double>(theta + step));
    });
    EXPECT_LT((LeftJacobianSo3(theta) - numeric).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_P(So3JacobianAtAngle, LeftJacobianInverse_IsTheDerivativeOfLog) {
  for (int i = 0; i < 20; ++i) {
    const Vec3d theta = AnyTurn();
    const Mat3d numeric =
        Derivative([&](const Vec3d& step) { return LogSo3<double>(ExpSo3(step) * ExpSo3(theta)); });
    EXPECT_LT((LeftJacobianInverseSo3(theta) - numeric).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_P(So3JacobianAtAngle, SinglePrecision_FollowsDoublePrecision) {
  for (int i = 0; i < 20; ++i) {
    const Vec3 theta = AnyTurn().cast<float>();
    const Vec3d exact = theta.cast<double>();
    EXPECT_LT((LeftJacobianSo3(theta).cast<double>() - LeftJacobianSo3(exact)).norm(), 2e-5);
    EXPECT_LT((LeftJacobianInverseSo3(theta).cast<double>() - LeftJacobianInverseSo3(exact)).norm(),
              2e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, So3JacobianAtAngle,
                         ::testing::Values(0.0, 1e-6, 0.0099, 0.0101, 0.0999, 0.1001, 0.1999,
                                           0.2001, 1.0, 2.5, 3.0),
                         [](const auto& angle) { return "Case" + std::to_string(angle.index); });

TEST(Skew, IsTheCrossProduct) {
  const Vec3 a(1.0F, -2.0F, 0.5F);
  const Vec3 b(0.3F, 4.0F, -1.0F);
  EXPECT_LT((Skew(a) * b - a.cross(b)).norm(), 1e-6F);
}

}  // namespace
}  // namespace disflow::testing
