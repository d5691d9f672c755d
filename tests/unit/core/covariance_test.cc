// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/geometry/covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "disflow/geometry/transform.h"
#include "symmetric_matrix.h"

namespace disflow {
namespace {

const Mat3 kRotation = ExpSo3(Vec3(0.3F, -1.1F, 0.7F));
const Vec3 kLever_m(0.4F, -0.2F, 0.9F);

/// The covariance of displacements whose covariance is given, after `move` was applied to each of
/// them: one displacement per column of a square root, without any Jacobian.
template <class Move>
Mat6 OfMovedDisplacements(const Mat6& covariance, const Move& move) {
  const Mat6 root = covariance.llt().matrixL();
  Mat6 result = Mat6::Zero();
  for (int i = 0; i < 6; ++i) {
    Vec6 moved;
    move(Vec3(root.col(i).head<3>()), Vec3(root.col(i).tail<3>()), moved);
    result += moved * moved.transpose();
  }
  return result;
}

TEST(RotatedCovariance, IsTheCovarianceOfTheRotatedVectors) {
  const Mat6 covariance = testing::RandomPositiveDefinite(1);
  const Mat6 expected =
      OfMovedDisplacements(covariance, [](const Vec3& first, const Vec3& second, Vec6& moved) {
        moved.head<3>() = kRotation * first;
        moved.tail<3>() = kRotation * second;
      });
  EXPECT_LT((RotatedCovariance(covariance, kRotation) - expected).norm(), 1e-5F * expected.norm());
}

TEST(ScaledCovariance, IsTheCovarianceOfTheScaledVectors) {
  const Mat6 covariance = testing::RandomPositiveDefinite(1);
  const Mat6 expected =
      OfMovedDisplacements(covariance, [](const Vec3& first, const Vec3& second, Vec6& moved) {
        moved.head<3>() = 2.0F * first;
        moved.tail<3>() = 0.1F * second;
      });
  EXPECT_LT((ScaledCovariance(covariance, 4.0F, 0.01F) - expected).norm(), 1e-5F * expected.norm());
}

TEST(CovarianceAtPoint, IsTheCovarianceOfTheOtherPointsDisplacement) {
  const Mat6 covariance = testing::RandomPositiveDefinite(2);
  const Mat6 expected =
      OfMovedDisplacements(covariance, [](const Vec3& shift_m, const Vec3& turn_rad, Vec6& moved) {
        moved.head<3>() = kRotation * (shift_m + turn_rad.cross(kLever_m));
        moved.tail<3>() = kRotation * turn_rad;
      });
  EXPECT_LT((CovarianceAtPoint(covariance, kRotation, kLever_m) - expected).norm(),
            1e-5F * expected.norm());
}

TEST(CovarianceAtPoint, ThereAndBack_IsTheSame) {
  const Mat6 covariance = testing::RandomPositiveDefinite(3);
  const Mat6 there = CovarianceAtPoint(covariance, kRotation, kLever_m);
  const Mat6 back = CovarianceAtPoint(there, kRotation.transpose(), Vec3(-(kRotation * kLever_m)));
  EXPECT_LT((back - covariance).norm(), 1e-5F * there.norm());
}

TEST(VelocityCovarianceOfPlace, IsThatOfRateTimesDisplacement) {
  const Mat6 place_and_rate = testing::RandomPositiveDefinite(4);
  const Mat3 place_m2 = place_and_rate.topLeftCorner<3, 3>();
  const Mat3 rate2_rps2 = place_and_rate.bottomRightCorner<3, 3>();
  const Mat3 places_m = place_m2.llt().matrixL();
  const Mat3 rates_rps = rate2_rps2.llt().matrixL();
  Mat3 expected = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Vec3 velocity_mps = Vec3(rates_rps.col(i)).cross(Vec3(places_m.col(j)));
      expected += velocity_mps * velocity_mps.transpose();
    }
  }
  EXPECT_LT((VelocityCovarianceOfPlace(place_m2, rate2_rps2) - expected).norm(),
            1e-5F * expected.norm());
}

TEST(CovarianceAtPoint, OfATurn_ShowsAtTheEndOfTheLever) {
  Mat6 turn = Mat6::Zero();
  turn(5, 5) = 0.01F;  // 0.1 rad about z
  const Mat6 moved = CovarianceAtPoint(turn, Mat3::Identity(), Vec3(0.2F, 0.0F, 0.0F));
  EXPECT_NEAR(std::sqrt(moved(1, 1)), 0.02F, 1e-6F);
  EXPECT_NEAR(moved(1, 5), 0.02F * 0.1F, 1e-7F);
  EXPECT_NEAR(moved(0, 0), 0.0F, 1e-9F);
}

/// Of a rotation of any size about a point far away, beside next to nothing.
TEST(Resolvable, HasACholeskyFactorWhateverIsUnknown) {
  const Vec3 axis = Vec3(0.6F, -0.64F, 0.48F);
  for (const float std_rad : {0.0F, 1e-3F, 0.1F, 1.0F, 3.0F}) {
    Vec6 turn;
    turn << kLever_m.cross(axis), axis;
    const Mat6 covariance = 1e-10F * Mat6::Identity() + std_rad * std_rad * turn * turn.transpose();
    const Mat6 moved = CovarianceAtPoint(covariance, kRotation, kLever_m);
    const Vec6 beside = Vec6::Constant(2.0F * std_rad * std_rad * kLever_m.squaredNorm());
    const Mat6 resolvable = Resolvable(moved, beside);
    EXPECT_EQ(resolvable.llt().info(), Eigen::Success) << std_rad;
    EXPECT_LT((resolvable - moved).norm(), 1e-5F * (moved.norm() + beside.norm())) << std_rad;
  }
}

/// What is added up with something larger is rounded as that is.
TEST(Resolvable, IsRoundedAsWhatItIsAddedTo) {
  const Vec6 beside = Vec6::Constant(4.0F);
  EXPECT_GE(Resolvable(Mat6::Zero(), beside).diagonal().minCoeff(), 1e-6F);
  EXPECT_EQ(Resolvable(Mat6::Zero()), Mat6::Zero());
}

}  // namespace
}  // namespace disflow
