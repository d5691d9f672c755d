// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace disflow {
namespace {

/// Evenly distributed among the rotations by at most an angle.
Mat3 RandomRotation(std::mt19937& random, float most_rad) {
  std::normal_distribution<float> any;
  for (;;) {
    const Eigen::Quaternionf turn =
        Eigen::Quaternionf(any(random), any(random), any(random), any(random)).normalized();
    if (2.0F * std::acos(std::min(std::abs(turn.w()), 1.0F)) <= most_rad)
      return turn.toRotationMatrix();
  }
}

Vec3 RandomPoint(std::mt19937& random) {
  std::uniform_real_distribution<float> any(-1.0F, 1.0F);
  const float x = any(random);
  const float y = any(random);
  return {x, y, any(random)};
}

float AngleBetween(const Mat3& a, const Mat3& b) { return TurnBetween(b, a).norm(); }

TEST(HalfWay, Pose_IsAsFarFromBoth) {
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const PoseObjectFromCamera a(RandomRotation(random, 1.0F), RandomPoint(random));
    const PoseObjectFromCamera b(Mat3(RandomRotation(random, 1.0F) * a.rotation()),
                                 RandomPoint(random));
    const Vec3 center_c = RandomPoint(random);
    const PoseObjectFromCamera middle = HalfWay(center_c, a, b);
    EXPECT_LT((middle * center_c - 0.5F * (a * center_c + b * center_c)).norm(), 1e-5F);
    EXPECT_NEAR(AngleBetween(middle.rotation(), a.rotation()),
                AngleBetween(middle.rotation(), b.rotation()), 1e-3F);
  }
}

TEST(PrincipalAxes, OfABox_AreItsSides) {
  const Mat3 turn = ExpSo3(Vec3(0.3F, -0.5F, 0.8F));
  const Vec3 squares_m2(1e-4F, 9e-4F, 4e-4F);
  const Mat3 axes = PrincipalAxes(turn * squares_m2.asDiagonal() * turn.transpose());
  EXPECT_TRUE((axes.transpose() * axes).isApprox(Mat3::Identity(), 1e-4F));
  const Mat3 along = (turn.transpose() * axes).cwiseAbs();
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(along.col(i).maxCoeff(), 1.0F, 1e-3F) << i;
}

TEST(TurnedOver, KeepsTheAxisWhereItIsAndIsItsOwnInverse) {
  const PoseObjectFromCamera T_oc(ExpSo3(Vec3(0.2F, 0.4F, -0.1F)), Vec3(0.1F, -0.2F, 0.7F));
  const Vec3 axis = Vec3(1.0F, 2.0F, -1.0F).normalized();
  const Vec3 center_m(0.01F, 0.02F, 0.03F);
  const PoseObjectFromCamera over = TurnedOver(T_oc, axis, center_m);
  const Vec3 on_axis_c = T_oc.Inverse() * Vec3(center_m + 0.05F * axis);
  EXPECT_LT((over * on_axis_c - T_oc * on_axis_c).norm(), 1e-5F);
  EXPECT_NEAR(TurnBetween(T_oc.rotation(), over.rotation()).norm(), 3.14159F, 1e-3F);
  const PoseObjectFromCamera back = TurnedOver(over, axis, center_m);
  EXPECT_TRUE(back.rotation().isApprox(T_oc.rotation(), 1e-5F));
  EXPECT_LT((back.translation() - T_oc.translation()).norm(), 1e-5F);
}

}  // namespace
}  // namespace disflow
