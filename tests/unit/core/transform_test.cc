// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/geometry/transform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>

#include "random_motion.h"

namespace disflow::testing {
namespace {

// Frames are part of the type: what makes no sense does not compile.
template <class A, class B>
concept Composable = requires(const A& a, const B& b) {
  a* b;
};
static_assert(Composable<PoseObjectFromCamera, PoseCameraFromObject>);
static_assert(!Composable<PoseObjectFromCamera, PoseObjectFromCamera>);
static_assert(!Composable<PoseCameraFromObject, PoseCameraFromObject>);
static_assert(!Composable<Transform<World, Camera>, PoseObjectFromCamera>);
static_assert(!std::is_assignable_v<PoseObjectFromCamera&, PoseCameraFromObject>);
static_assert(!std::is_constructible_v<PoseObjectFromCamera, PoseCameraFromObject>);
static_assert(std::is_same_v<decltype(PoseObjectFromCamera().Inverse()), PoseCameraFromObject>);
static_assert(std::is_same_v<decltype(Transform<World, Camera>() * PoseCameraFromObject()),
                             Transform<World, Object>>);

constexpr double kPi = std::numbers::pi;

template <class T>
auto Difference(const T& a, const T& b) {
  return std::max((a.rotation() - b.rotation()).cwiseAbs().maxCoeff(),
                  (a.translation() - b.translation()).cwiseAbs().maxCoeff());
}

class AtAngle : public ::testing::TestWithParam<double> {};

TEST_P(AtAngle, LogOfExp_IsTheSameTwist) {
  RandomMotion random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec6d xi = random.Twist(GetParam());
    EXPECT_LT((MotionAB::Exp(xi).Log() - xi).norm(), 1e-9) << xi.transpose();
  }
}

TEST_P(AtAngle, ExpOfLog_IsTheSameMotion) {
  RandomMotion random(2);
  for (int i = 0; i < 50; ++i) {
    const MotionAB motion = MotionAB::Exp(random.Twist(GetParam()));
    EXPECT_LT(Difference(MotionAB::Exp(motion.Log()), motion), 1e-9);
  }
}

TEST_P(AtAngle, ExpOfNegative_IsTheInverse) {
  RandomMotion random(3);
  for (int i = 0; i < 50; ++i) {
    const Vec6d xi = random.Twist(GetParam());
    EXPECT_LT(Difference(MotionBA::Exp(-xi), MotionAB::Exp(xi).Inverse()), 1e-12);
  }
}

TEST_P(AtAngle, Rotation_IsOrthonormalAndRightHanded) {
  RandomMotion random(4);
  for (int i = 0; i < 50; ++i) {
    const Mat<double, 3, 3> r = MotionAB::Exp(random.Twist(GetParam())).rotation();
    EXPECT_LT((r * r.transpose() - Mat<double, 3, 3>::Identity()).norm(), 1e-12);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
  }
}

TEST_P(AtAngle, SinglePrecision_FollowsDoublePrecision) {
  RandomMotion random(5);
  for (int i = 0; i < 50; ++i) {
    const Vec6 xi = random.Twist(GetParam()).cast<float>();
    const auto single = Transform<FrameA, FrameB>::Exp(xi);
    const MotionAB exact = MotionAB::Exp(xi.cast<double>());
    EXPECT_LT(Difference(single.Cast<double>(), exact), 2e-6) << xi.transpose();
  }
}

TEST_P(AtAngle, LogInSinglePrecision_LosesLittle) {
  using Motion = Transform<FrameA, FrameB>;
  // Within rounding of pi the axis may flip: the twist differs then, the motion does not.
  const bool unique = GetParam() < 3.0;
  RandomMotion random(6);
  for (int i = 0; i < 50; ++i) {
    const Vec6 xi = random.Twist(GetParam()).cast<float>();
    const Motion motion = Motion::Exp(xi);
    EXPECT_LT(Difference(Motion::Exp(motion.Log()), motion), 5e-6F) << xi.transpose();
    if (unique) {
      EXPECT_LT((motion.Log() - xi).norm(), 5e-6F) << xi.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Angles, AtAngle,
                         ::testing::Values(0.0, 1e-10, 1e-6, 1e-3, 0.0099, 0.0101, 0.0999, 0.1001,
                                           0.1999, 0.2001, 1.0, 2.5, kPi - 1e-3, kPi - 1e-6),
                         [](const auto& angle) { return "Case" + std::to_string(angle.index); });

TEST(Transform, HalfTurn_LogHasAnglePi) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec6d xi = Vec6d::Zero();
    xi(3 + axis) = kPi;
    const Vec6d log = MotionAB::Exp(xi).Log();
    EXPECT_NEAR(log.tail<3>().norm(), kPi, 1e-9);
    EXPECT_NEAR(std::abs(log(3 + axis)), kPi, 1e-9);
  }
}

TEST(Transform, SingleAxisRotation_IsTheTextbookMatrix) {
  Vec6d xi = Vec6d::Zero();
  xi(5) = 0.3;  // about z: x turns towards y
  const Mat<double, 3> turned = MotionAB::Exp(xi) * Mat<double, 3>(1.0, 0.0, 0.0);
  EXPECT_NEAR(turned.x(), std::cos(0.3), 1e-15);
  EXPECT_NEAR(turned.y(), std::sin(0.3), 1e-15);
  EXPECT_NEAR(turned.z(), 0.0, 1e-15);
}

TEST(Transform, Screw_TranslatesAlongItsAxis) {
  const Vec6d xi = (Vec6d() << 0.0, 0.0, 0.7, 0.0, 0.0, 2.0).finished();
  const Mat<double, 3> moved = MotionAB::Exp(xi) * Mat<double, 3>(0.0, 0.0, 1.0);
  EXPECT_LT((moved - Mat<double, 3>(0.0, 0.0, 1.7)).norm(), 1e-15);
}

TEST(Transform, Exp_IsTheFlowOfItsTwist) {
  // x' = omega x + rho, integrated with many small steps of the implicit midpoint rule.
  RandomMotion random(7);
  const Vec6d xi = random.Twist(1.3);
  const Mat<double, 3> start(0.2, -0.4, 0.7);
  Mat<double, 3> x = start;
  constexpr int kSteps = 20000;
  constexpr double kStep = 1.0 / kSteps;
  const Mat<double, 3, 3> half = 0.5 * kStep * Skew<double>(xi.tail<3>());
  const Mat<double, 3, 3> left = (Mat<double, 3, 3>::Identity() - half).inverse();
  for (int i = 0; i < kSteps; ++i) x = left * (x + half * x + kStep * xi.head<3>());
  EXPECT_LT((MotionAB::Exp(xi) * start - x).norm(), 1e-8);
}

TEST(Transform, Composition_IsAssociative) {
  RandomMotion random(8);
  for (int i = 0; i < 50; ++i) {
    const MotionAB a = MotionAB::Exp(random.Twist(2.0));
    const MotionBA b = MotionBA::Exp(random.Twist(1.0));
    const MotionAB c = MotionAB::Exp(random.Twist(3.0));
    EXPECT_LT(Difference((a * b) * c, a * (b * c)), 1e-14);
  }
}

TEST(Transform, Composition_MapsPointsOneAfterTheOther) {
  RandomMotion random(9);
  const MotionAB a = MotionAB::Exp(random.Twist(2.0));
  const MotionBA b = MotionBA::Exp(random.Twist(1.0));
  const Mat<double, 3> x(0.1, 0.2, -0.3);
  EXPECT_LT(((a * b) * x - a * (b * x)).norm(), 1e-15);
}

TEST(Transform, Inverse_UndoesFromBothSides) {
  RandomMotion random(10);
  for (int i = 0; i < 50; ++i) {
    const MotionAB motion = MotionAB::Exp(random.Twist(2.8));
    EXPECT_LT(Difference(motion * motion.Inverse(), Transform<FrameA, FrameA, double>()), 1e-14);
    EXPECT_LT(Difference(motion.Inverse() * motion, Transform<FrameB, FrameB, double>()), 1e-14);
  }
}

TEST(Transform, Identity_ChangesNothing) {
  RandomMotion random(11);
  const MotionAB motion = MotionAB::Exp(random.Twist(2.0));
  EXPECT_EQ(Difference(motion * Transform<FrameB, FrameB, double>(), motion), 0.0);
  EXPECT_EQ(Difference(Transform<FrameA, FrameA, double>() * motion, motion), 0.0);
  EXPECT_EQ(MotionAB().Log().norm(), 0.0);
}

TEST(Transform, Adjoint_MovesTwistsThroughTheMotion) {
  // T exp(xi) T^-1 = exp(Ad xi)
  RandomMotion random(12);
  for (int i = 0; i < 50; ++i) {
    const MotionAB motion = MotionAB::Exp(random.Twist(2.0));
    const Vec6d xi = random.Twist(1.5);
    const auto moved = motion * Transform<FrameB, FrameB, double>::Exp(xi) * motion.Inverse();
    const auto expected = Transform<FrameA, FrameA, double>::Exp(motion.Adjoint() * xi);
    EXPECT_LT(Difference(moved, expected), 1e-12);
  }
}

TEST(Transform, AdjointOfProduct_IsProductOfAdjoints) {
  RandomMotion random(13);
  const MotionAB a = MotionAB::Exp(random.Twist(2.0));
  const MotionBA b = MotionBA::Exp(random.Twist(1.0));
  EXPECT_LT(((a * b).Adjoint() - a.Adjoint() * b.Adjoint()).norm(), 1e-14);
  EXPECT_LT((a.Inverse().Adjoint() * a.Adjoint() - Mat<double, 6, 6>::Identity()).norm(), 1e-14);
}

TEST(Transform, Quaternion_GivesTheSameRotation) {
  RandomMotion random(14);
  const MotionAB motion = MotionAB::Exp(random.Twist(2.0));
  const MotionAB again(motion.rotation_quaternion(), motion.translation());
  EXPECT_LT(Difference(again, motion), 1e-14);
}

TEST(Transform, UnnormalisedQuaternion_IsNormalised) {
  const MotionAB::Quaternion twice(2.0, 0.0, 0.0, 0.0);
  EXPECT_EQ(Difference(MotionAB(twice, MotionAB::Vector3::Zero()), MotionAB()), 0.0);
}

TEST(Transform, Normalized_BringsADriftedRotationBack) {
  RandomMotion random(15);
  const MotionAB motion = MotionAB::Exp(random.Twist(2.0));
  const MotionAB drifted(MotionAB::Matrix3(motion.rotation() * 1.001), motion.translation());
  const MotionAB::Matrix3 r = drifted.Normalized().rotation();
  EXPECT_LT((r * r.transpose() - MotionAB::Matrix3::Identity()).norm(), 1e-14);
}

TEST(Transform, ManySinglePrecisionProducts_StayRigidWhenNormalised) {
  using T = Transform<FrameA, FrameA>;
  T motion;
  const T step = T::Exp((Vec6() << 0.001F, -0.002F, 0.0F, 0.02F, 0.01F, -0.03F).finished());
  for (int i = 0; i < 10000; ++i) motion = (step * motion).Normalized();
  EXPECT_LT((motion.rotation() * motion.rotation().transpose() - Mat3::Identity()).norm(), 1e-6F);
}

TEST(Transform, NotFinite_IsSeen) {
  PoseObjectFromCamera pose;
  EXPECT_TRUE(pose.IsFinite());
  const Vec3 nowhere(0.0F, std::numeric_limits<float>::infinity(), 0.0F);
  EXPECT_FALSE(PoseObjectFromCamera(Mat3(Mat3::Identity()), nowhere).IsFinite());
  const Mat3 broken = Mat3::Constant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(PoseObjectFromCamera(broken, Vec3(Vec3::Zero())).IsFinite());
}

}  // namespace
}  // namespace disflow::testing
