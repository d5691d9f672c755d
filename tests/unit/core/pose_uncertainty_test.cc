// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_uncertainty.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "disflow/flow/normal_equations.h"
#include "disflow/flow/residual_sums_impl.h"
#include "disflow/geometry/covariance.h"
#include "disflow/geometry/transform.h"

namespace disflow {
namespace {

constexpr float kRadius_m = 0.03F;
constexpr float kSigma_m = 0.001F;
constexpr float kGradientStd_rad = 0.025F;

/// Residuals on a body of revolution about z, seen from -y, whose gradients are off at random.
/// @param ridge 0: a can; else how far normals lean aside, as those of an oval bottle do.
RegistrationInformation SeenBody(float gradient_std, float ridge = 0.0F) {
  std::mt19937 random(3);
  std::normal_distribution<float> off(0.0F, gradient_std);
  std::uniform_real_distribution<float> angle(-1.2F, 1.2F);
  std::uniform_real_distribution<float> height_m(-0.05F, 0.05F);
  NormalSums sums;
  for (int i = 0; i < 500; ++i) {
    const float a = angle(random);
    const float z_m = height_m(random);
    const bool lid = i % 10 == 0;  // so that the height is known
    const Vec3 point_m(kRadius_m * std::sin(a), -kRadius_m * std::cos(a), z_m);
    const float b = a + ridge * std::sin(2.0F * a);
    const Vec3 side(std::sin(b), -std::cos(b), 0.0F);
    const Vec3 gradient =
        ((lid ? Vec3(Vec3::UnitZ()) : side) + Vec3(off(random), off(random), off(random)))
            .normalized();
    sums.Add(point_m, gradient, 0.0F, 1.0F / (kSigma_m * kSigma_m));
  }
  NormalEquations equations;
  equations += sums;
  return {equations.h, equations.h, equations.Isotropic() - equations.h};
}

float Std(const Mat6& covariance, int i) { return std::sqrt(covariance(i, i)); }

TEST(PoseUncertainty, ExactGradients_GiveTheInverseOfTheInformation) {
  const RegistrationInformation information = SeenBody(0.0F, 0.4F);
  const PoseUncertainty uncertainty = FindPoseUncertainty(information, 0.0F);
  ASSERT_TRUE(uncertainty.solved);
  EXPECT_TRUE(uncertainty.IsComplete());
  EXPECT_FALSE(uncertainty.MayShift());
  EXPECT_LT((information.total * uncertainty.covariance - Mat6::Identity()).norm(), 0.05F);
}

TEST(PoseUncertainty, TurnOfACan_IsUnobservedThoughGradientsSeemToTellIt) {
  const RegistrationInformation information = SeenBody(0.02F);
  // What errors of the gradients pretend: the turn would be known to a few degrees.
  EXPECT_GT(information.total(5, 5), 1.0F / (0.1F * 0.1F));
  const PoseUncertainty uncertainty = FindPoseUncertainty(information, kGradientStd_rad);
  ASSERT_TRUE(uncertainty.solved);
  EXPECT_FALSE(uncertainty.IsComplete());
  EXPECT_GT(Std(uncertainty.covariance, 5), 0.2F);
  EXPECT_LT(20.0F * Std(uncertainty.of_observed, 5), Std(uncertainty.covariance, 5));
  // The direction is the turn about the axis, and as fast as anything may turn.
  EXPECT_NEAR(uncertainty.unobserved(5, 5), 9.0F, 0.5F);
  EXPECT_LT((uncertainty.unobserved.topLeftCorner<3, 3>().norm()), 0.01F);
  EXPECT_TRUE(uncertainty.free_turn.isApprox(uncertainty.unobserved));
  EXPECT_FALSE(uncertainty.MayShift());
  // What is observed stays known.
  for (int i = 0; i < 3; ++i) EXPECT_LT(Std(uncertainty.covariance, i), 3e-4F) << i;
  for (int i = 3; i < 5; ++i) EXPECT_LT(Std(uncertainty.covariance, i), 5e-3F) << i;
}

TEST(KnownTwist, TurnAboutAFreeAxis_IsLeftOutOnceNothingToldItForLong) {
  const Mat6 free_turn = FindPoseUncertainty(SeenBody(0.02F), kGradientStd_rad).free_turn;
  const Twist twist{Vec3(0.1F, -0.2F, 0.3F), Vec3(0.5F, 1.0F, 7.0F)};
  const Twist known = KnownTwist(twist, free_turn, 2.0F);
  EXPECT_LT(std::abs(known.angular_rps.z()), 0.1F * twist.angular_rps.z());
  EXPECT_LT((known.angular_rps - twist.angular_rps).head<2>().norm(), 0.15F);
  EXPECT_LT((known.linear_mps - twist.linear_mps).norm(), 0.02F);
  // What was known a moment ago still is.
  EXPECT_EQ(KnownTwist(twist, free_turn, 1.0F).angular_rps, twist.angular_rps);
  EXPECT_EQ(KnownTwist(twist, Mat6::Zero(), 2.0F).angular_rps, twist.angular_rps);
}

TEST(KnownTwist, OfAPointBesideTheAxis_LosesWhatTheTurnMovedItBy) {
  const Mat6 about_axis = FindPoseUncertainty(SeenBody(0.02F), kGradientStd_rad).free_turn;
  const Vec3 beside_m(0.1F, 0.0F, 0.0F);
  const Mat6 free_turn = CovarianceAtPoint(about_axis, Mat3::Identity(), beside_m);
  const Vec3 turn_rps(0.0F, 0.0F, 5.0F);
  const Vec3 moves_mps(0.0F, 0.0F, 0.2F);
  const Twist known =
      KnownTwist({Vec3(moves_mps + turn_rps.cross(beside_m)), turn_rps}, free_turn, 2.0F);
  EXPECT_LT((known.linear_mps - moves_mps).norm(), 0.06F);
  EXPECT_LT(known.angular_rps.norm(), 0.5F);
}

/// Edges along the body's axis, which tell its turn.
RegistrationInformation WithEdges(RegistrationInformation information, int edges, float std_m) {
  NormalSums sums;
  for (int i = 0; i < edges; ++i) {
    const float z_m = 0.1F * static_cast<float>(i) / static_cast<float>(edges) - 0.05F;
    sums.Add(Vec3(0.0F, -kRadius_m, z_m), Vec3::UnitX(), 0.0F, 1.0F / (std_m * std_m));
  }
  NormalEquations equations;
  equations += sums;
  information.total += equations.h;
  return information;
}

TEST(PoseUncertainty, TurnThatEdgesTell_IsObservedAsWellAsTheyTellIt) {
  constexpr int kEdges = 50;
  constexpr float kEdgeStd_m = 1e-3F;
  const RegistrationInformation information = WithEdges(SeenBody(0.02F), kEdges, kEdgeStd_m);
  const PoseUncertainty uncertainty = FindPoseUncertainty(information, kGradientStd_rad);
  ASSERT_TRUE(uncertainty.solved);
  EXPECT_TRUE(uncertainty.IsComplete());
  const float by_edges_rad = kEdgeStd_m / (kRadius_m * std::sqrt(float{kEdges}));
  EXPECT_GT(Std(uncertainty.covariance, 5), 0.8F * by_edges_rad);
  EXPECT_LT(Std(uncertainty.covariance, 5), 1.3F * by_edges_rad);
}

TEST(PoseUncertainty, TurnThatEdgesTellByTheirErrors_StaysUnobserved) {
  RegistrationInformation information = WithEdges(SeenBody(0.02F), 50, 1e-3F);
  information.of_edge_errors = 0.6F * (information.total - information.surface);
  const PoseUncertainty uncertainty = FindPoseUncertainty(information, kGradientStd_rad);
  ASSERT_TRUE(uncertainty.solved);
  EXPECT_FALSE(uncertainty.IsComplete());
  EXPECT_NEAR(uncertainty.unobserved(5, 5), 9.0F, 0.5F);
}

TEST(PoseUncertainty, ErrorsOfEdges_TakeNothingOffWhatTheSurfaceTells) {
  RegistrationInformation information = SeenBody(0.0F, 0.4F);
  information.of_edge_errors = 100.0F * information.total;
  const PoseUncertainty uncertainty = FindPoseUncertainty(information, 0.0F);
  ASSERT_TRUE(uncertainty.solved);
  EXPECT_TRUE(uncertainty.IsComplete());
  EXPECT_LT((information.total * uncertainty.covariance - Mat6::Identity()).norm(), 0.05F);
}

TEST(PoseUncertainty, TurnThatAFewVagueEdgesTell_StaysUnobserved) {
  const RegistrationInformation information = WithEdges(SeenBody(0.02F), 3, 20e-3F);
  const PoseUncertainty uncertainty = FindPoseUncertainty(information, kGradientStd_rad);
  ASSERT_TRUE(uncertainty.solved);
  EXPECT_FALSE(uncertainty.IsComplete());
  EXPECT_NEAR(uncertainty.unobserved(5, 5), 9.0F, 0.5F);
}

TEST(PoseUncertainty, ErrorThatTheFrameShows_CountsLikeOneThatIsKnown) {
  RegistrationInformation information = SeenBody(0.02F);
  const PoseUncertainty known = FindPoseUncertainty(information, kGradientStd_rad);
  EXPECT_TRUE(FindPoseUncertainty(information, 0.0F).IsComplete());
  information.gradient_variance_rad2 = kGradientStd_rad * kGradientStd_rad;
  const PoseUncertainty shown = FindPoseUncertainty(information, 0.0F);
  EXPECT_FALSE(shown.IsComplete());
  EXPECT_LT((shown.covariance - known.covariance).norm(), 1e-4F * known.covariance.norm());
  // Both together are more.
  const PoseUncertainty both = FindPoseUncertainty(information, kGradientStd_rad);
  EXPECT_GT(Std(both.covariance, 3), Std(known.covariance, 3));
}

TEST(PoseUncertainty, TurnOfAnOvalBody_IsObservedAndHardlyTouched) {
  const RegistrationInformation information = SeenBody(0.02F, 0.3F);
  const PoseUncertainty without = FindPoseUncertainty(information, 0.0F);
  const PoseUncertainty with = FindPoseUncertainty(information, kGradientStd_rad);
  EXPECT_TRUE(with.IsComplete());
  EXPECT_GT(Std(with.covariance, 5), Std(without.covariance, 5));
  EXPECT_LT(Std(with.covariance, 5), 1.3F * Std(without.covariance, 5));
}

TEST(PoseUncertainty, Plane_LeavesItsTwoShiftsAndItsTurnUnobserved) {
  NormalSums sums;
  for (int i = 0; i < 400; ++i) {
    const Vec3 point_m(0.004F * static_cast<float>(i % 20 - 10),
                       0.004F * static_cast<float>(i / 20 - 10), 0.0F);
    sums.Add(point_m, Vec3::UnitZ(), 0.0F, 1e6F);
  }
  NormalEquations equations;
  equations += sums;
  const PoseUncertainty uncertainty = FindPoseUncertainty(
      {equations.h, equations.h, equations.Isotropic() - equations.h}, kGradientStd_rad);
  ASSERT_TRUE(uncertainty.solved);
  EXPECT_GT(uncertainty.unobserved(0, 0), 0.1F);
  EXPECT_GT(uncertainty.unobserved(1, 1), 0.1F);
  EXPECT_GT(uncertainty.unobserved(5, 5), 1.0F);
  for (int i : {2, 3, 4}) EXPECT_LT(uncertainty.unobserved(i, i), 0.01F) << i;
  EXPECT_LT(Std(uncertainty.covariance, 2), 1e-4F);
}

TEST(PoseUncertainty, ShiftOfAPlane_IsNoTurnAboutAnAxis) {
  NormalSums sums;
  for (int i = 0; i < 200; ++i) {
    const Vec3 point_m(0.01F * static_cast<float>(i % 20), 0.01F * static_cast<float>(i / 20),
                       0.0F);
    sums.Add(point_m - Vec3(0.095F, 0.045F, 0.0F), Vec3::UnitZ(), 0.0F, 1e6F);
  }
  NormalEquations equations;
  equations += sums;
  const PoseUncertainty uncertainty = FindPoseUncertainty(
      {equations.h, equations.h, equations.Isotropic() - equations.h}, kGradientStd_rad);
  ASSERT_FALSE(uncertainty.IsComplete());
  // Of all that is unobserved only the turn within the plane is one.
  EXPECT_LT((uncertainty.free_turn.topLeftCorner<3, 3>().norm()), 0.1F);
  EXPECT_LT(uncertainty.free_turn.diagonal()[3] + uncertainty.free_turn.diagonal()[4], 0.1F);
  EXPECT_TRUE(uncertainty.MayShift());
}

TEST(PoseUncertainty, NotFiniteOrEmptyInformation_IsNotSolved) {
  RegistrationInformation information;
  EXPECT_FALSE(FindPoseUncertainty(information, kGradientStd_rad).solved);
  information = SeenBody(0.0F, 0.3F);
  information.total(2, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(FindPoseUncertainty(information, kGradientStd_rad).solved);
}

TEST(GradientVariance, RisesAtOnceAndFallsSlowly) {
  EXPECT_EQ(RememberGradientVariance(0.0F, 0.01F), 0.01F);
  EXPECT_EQ(RememberGradientVariance(0.01F, 0.02F), 0.02F);
  float remembered = 0.02F;
  // One frame that agrees with the model by chance.
  remembered = RememberGradientVariance(remembered, 0.0F);
  EXPECT_GT(remembered, 0.018F);
  for (int frame = 0; frame < 200; ++frame) {
    const float next = RememberGradientVariance(remembered, 0.001F);
    EXPECT_LE(next, remembered);
    remembered = next;
  }
  EXPECT_NEAR(remembered, 0.001F, 1e-5F);
}

TEST(GradientVariance, OfAFrameThatTellsNothing_StaysAsItIs) {
  EXPECT_EQ(RememberGradientVariance(0.01F, std::numeric_limits<float>::quiet_NaN()), 0.01F);
}

// A point on a circle, turned by an angle that is anything up to a bound: what is said of where it
// is are the moments of such points.
TEST(OnItsArc, HasTheMomentsOfATurnedPoint) {
  const Vec3 axis = Vec3(1.0F, -2.0F, 3.0F).normalized();
  const Vec3 radius_m = kRadius_m * axis.cross(Vec3::UnitX()).normalized();
  for (const float bound : {0.1F, 0.45F, 0.55F, 1.5F, 3.1415F}) {
    Mat6 truth = Mat6::Zero();
    constexpr int kAngles = 2000;
    for (int i = 0; i < kAngles; ++i) {
      const float share =
          (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(kAngles) - 1.0F;
      Vec6 moved;
      moved.tail<3>() = share * bound * axis;
      moved.head<3>() = ExpSo3(Vec3(share * bound * axis)) * radius_m - radius_m;
      truth += moved * moved.transpose() / static_cast<float>(kAngles);
    }
    Mat6 turn = Mat6::Zero();
    turn.bottomRightCorner<3, 3>() = bound * bound / 3.0F * axis * axis.transpose();
    const Mat6 said = OnItsArc(CovarianceAtPoint(turn, Mat3::Identity(), radius_m));
    const float scale = truth.diagonal().maxCoeff();
    EXPECT_LT((said - truth).norm(), 0.01F * scale) << bound;
    const Mat3 off_m2 = (said - truth).topLeftCorner<3, 3>();
    const Mat3 true_m2 = truth.topLeftCorner<3, 3>();
    EXPECT_LT(off_m2.norm(), 0.01F * true_m2.norm()) << bound;
  }
}

// Shorter series for small angles gave a place that is told better by the angle than at all.
TEST(OnItsArc, WhateverTheAngle_IsACovariance) {
  const Vec3 axis = Vec3(1.0F, -2.0F, 3.0F).normalized();
  const Vec3 radius_m = 0.7F * axis.cross(Vec3::UnitX()).normalized();
  for (float bound = 0.1F; bound < 3.2F; bound += 0.01F) {
    Mat6 turn = Mat6::Zero();
    turn.bottomRightCorner<3, 3>() = bound * bound / 3.0F * axis * axis.transpose();
    const Eigen::Matrix<double, 6, 6> said =
        OnItsArc(CovarianceAtPoint(turn, Mat3::Identity(), radius_m)).cast<double>();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(said);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), -1e-6 * said.diagonal().maxCoeff()) << bound;
  }
}

TEST(OnItsArc, NoTurn_IsMoreThanHalfATurn) {
  Mat6 turn = Mat6::Zero();
  turn(5, 5) = 100.0F;
  const Mat6 said = OnItsArc(CovarianceAtPoint(turn, Mat3::Identity(), Vec3(kRadius_m, 0, 0)));
  EXPECT_NEAR(said(5, 5), 3.29F, 0.01F);
  EXPECT_NEAR(said(0, 0), 1.5F * kRadius_m * kRadius_m, 0.01F * kRadius_m * kRadius_m);
  EXPECT_NEAR(said(1, 1), 0.5F * kRadius_m * kRadius_m, 0.01F * kRadius_m * kRadius_m);
}

TEST(OnItsArc, WhatElseIsUncertain_StaysAsItIs) {
  Mat6 covariance = Mat6::Zero();
  covariance.diagonal() << 1e-4F, 2e-4F, 3e-4F, 1e-6F, 2e-6F, 3e-6F;
  EXPECT_LT((OnItsArc(covariance) - covariance).norm(), 1e-8F);
  EXPECT_EQ(OnItsArc(Mat6::Zero()), Mat6::Zero());
}

}  // namespace
}  // namespace disflow
