// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/turn_axis.h"

#include <gtest/gtest.h>

#include <random>

namespace disflow {
namespace {

constexpr float kRate_rps = 3.0F;

/// (Velocity of the origin, rate) of a turn about an axis.
Vec6 MotionAbout(const TurnAxis& axis) {
  const Vec3 rate = kRate_rps * axis.direction;
  Vec6 motion;
  motion << -rate.cross(axis.point_m), rate;
  return motion;
}

Mat6 Squared(const Vec6& motion) { return motion * motion.transpose(); }

/// Anywhere within a hand's breadth.
TurnAxis RandomAxis(std::mt19937& random) {
  std::normal_distribution<float> gaussian;
  const Vec3 direction = Vec3(gaussian(random), gaussian(random), gaussian(random)).normalized();
  const Vec3 point_m = 0.1F * Vec3(gaussian(random), gaussian(random), gaussian(random));
  return {direction, point_m - direction.dot(point_m) * direction};
}

TEST(AxisOf, FindsDirectionAndPlace_OfTheTurn) {
  std::mt19937 random(3);
  for (int i = 0; i < 50; ++i) {
    const TurnAxis axis = RandomAxis(random);
    const TurnAxis found = AxisOf(Squared(MotionAbout(axis)));
    EXPECT_NEAR(std::abs(found.direction.dot(axis.direction)), 1.0F, 1e-5F) << i;
    EXPECT_LT((found.point_m - axis.point_m).norm(), 1e-4F) << i;
  }
}

TEST(AxisOf, OfSeveralTurns_IsTheLargest) {
  const TurnAxis large{Vec3::UnitY(), Vec3(0.02F, 0.0F, -0.01F)};
  const TurnAxis small{Vec3::UnitX(), Vec3::Zero()};
  const Mat6 both = Squared(MotionAbout(large)) + Squared(Vec6(0.2F * MotionAbout(small)));
  const TurnAxis found = AxisOf(both);
  EXPECT_NEAR(std::abs(found.direction.y()), 1.0F, 1e-4F);
  EXPECT_LT((found.point_m - large.point_m).norm(), 1e-4F);
}

TEST(AxisOf, NoTurn_IsAFiniteAxis) {
  const TurnAxis found = AxisOf(Mat6::Zero());
  EXPECT_NEAR(found.direction.norm(), 1.0F, 1e-6F);
  EXPECT_TRUE(found.point_m.allFinite());
}

TEST(TurnedAbout, KeepsTheAxisWhereTheCameraSawIt_AndTurnsByTheAngle) {
  std::mt19937 random(4);
  const PoseObjectFromCamera T_oc(ExpSo3(Vec3(0.3F, -0.8F, 0.5F)), Vec3(0.1F, 0.2F, -0.6F));
  for (int i = 0; i < 50; ++i) {
    const TurnAxis axis = RandomAxis(random);
    const PoseObjectFromCamera T_turned = TurnedAbout(axis, 0.9F, T_oc);
    for (const float along_m : {-0.1F, 0.0F, 0.2F}) {
      const Vec3 x_m = axis.point_m + along_m * axis.direction;
      EXPECT_LT((T_turned.Inverse() * x_m - T_oc.Inverse() * x_m).norm(), 1e-5F) << i;
    }
    const Vec3 turn = TurnBetween(T_oc.rotation(), T_turned.rotation());
    EXPECT_LT((turn - 0.9F * axis.direction).norm(), 1e-4F) << i;
  }
}

}  // namespace
}  // namespace disflow
