// SPDX-License-Identifier: BSD-3-Clause
#include "pose_metrics.h"

#include <gtest/gtest.h>

#include <numbers>

#include "nearest_surface.h"
#include "run_builder.h"
#include "sphere_mesh.h"

namespace disflow::apps {
namespace {

/// Adds a camera-frame motion on the left of every pose but the first: it stays after the
/// alignment.
void Disturb(MadeUpRun& made, const Vec3d& translation_m, const Vec3d& rotation_rad) {
  for (std::size_t k = 1; k < made.estimates.rows.size(); ++k) {
    EstimatedPose& T_co = made.estimates.rows[k].T_co;
    const Vec3d centre = made.truth.T_ct[k].translation();
    const Mat3d turn = ExpSo3(rotation_rad);
    // About the true origin, so that the translation error is what was asked for.
    T_co = EstimatedPose(Mat3d(turn * T_co.rotation()),
                         Vec3d(turn * (T_co.translation() - centre) + centre + translation_m));
  }
}

TEST(PoseMetricsTest, PerfectRun_HasNoErrors) {
  const MadeUpRun made = MakeRun(30);
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  EXPECT_NEAR(m.add_auc, 1.0, 1e-12);
  EXPECT_NEAR(m.add_s_auc, 1.0, 1e-12);
  EXPECT_NEAR(m.add_m.max, 0.0, 1e-12);
  EXPECT_NEAR(m.rotation_rad.max, 0.0, 1e-12);
  EXPECT_NEAR(m.linear_mps.max, 0.0, 1e-12);
  EXPECT_NEAR(m.angular_rps.max, 0.0, 1e-12);
}

TEST(PoseMetricsTest, ConstantOffset_IsTheAddOfEveryFrameButTheAligned) {
  MadeUpRun made = MakeRun(5);
  Disturb(made, Vec3d(0.003, 0.0, 0.004), Vec3d::Zero());
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  EXPECT_NEAR(m.frames[0].add_m, 0.0, 1e-12);
  EXPECT_NEAR(m.frames[1].add_m, 0.005, 1e-12);
  EXPECT_NEAR(m.add_m.mean, 0.004, 1e-12);
  EXPECT_NEAR(m.add_auc, 1.0 - 0.04, 1e-12);
  EXPECT_NEAR(m.translation_m.rms, 0.005 * std::sqrt(0.8), 1e-12);
  EXPECT_NEAR(m.rotation_rad.max, 0.0, 1e-12);
  EXPECT_NEAR(m.final_translation_m, 0.005, 1e-12);
}

TEST(PoseMetricsTest, KnownRotation_IsFoundWithItsAngleAndLeverArm) {
  MadeUpRun made = MakeRun(2);
  const double angle = 0.1;
  // About the object's own z axis, so every corner of the cuboid moves by 2 r sin(angle / 2).
  const Vec3d axis = made.truth.T_ct[1].rotation() * Vec3d(0, 0, 1);
  Disturb(made, Vec3d::Zero(), Vec3d(angle * axis));
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  const double radius = std::hypot(0.08, 0.1);
  EXPECT_NEAR(m.frames[1].add_m, 2.0 * radius * std::sin(0.5 * angle), 1e-9);
  EXPECT_NEAR(m.frames[1].translation_m, 0.0, 1e-12);
  EXPECT_NEAR(m.final_rotation_rad, angle, 1e-9);
}

TEST(PoseMetricsTest, HalfTurnOfASymmetricObject_HurtsAddButNotAddS) {
  MadeUpRun made = MakeRun(2);
  const Vec3d axis = made.truth.T_ct[1].rotation() * Vec3d(0, 0, 1);
  Disturb(made, Vec3d::Zero(), Vec3d(std::numbers::pi * axis));
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  EXPECT_NEAR(m.frames[1].add_m, 2.0 * std::hypot(0.08, 0.1), 1e-9);
  EXPECT_NEAR(m.frames[1].add_s_m, 0.0, 1e-9);
  EXPECT_NEAR(m.add_auc, 0.5, 1e-9);
  EXPECT_NEAR(m.add_s_auc, 1.0, 1e-9);
}

TEST(PoseMetricsTest, AddS_AsksForTheNearestEstimatedPoint) {
  MadeUpRun made = MakeRun(2);
  for (std::size_t k = 0; k < 2; ++k) {
    made.truth.T_ct[k] = TruePose(Mat3d::Identity(), Vec3d(0, 0, 1));
    made.estimates.rows[k].T_co = EstimatedPose(Mat3d::Identity(), Vec3d(0.9 * double(k), 0, 1));
  }
  const std::vector<Vec3d> points = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(1.2, 0, 0)};
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), points);
  // Estimated points lie at 0.9, 1.9 and 2.1; the other direction would give (0.1 + 0.7 + 0.9) / 3.
  EXPECT_NEAR(m.frames[1].add_s_m, (0.9 + 0.1 + 0.3) / 3.0, 1e-12);
  EXPECT_NEAR(m.frames[1].add_m, 0.9, 1e-12);
}

TEST(PoseMetricsTest, TurnOfARoundObject_CostsNoAddSWhereTheSurfaceIsAsked) {
  // A sphere turned about its centre is the same sphere; its few points are others.
  MadeUpRun made = MakeRun(2);
  Disturb(made, Vec3d::Zero(), Vec3d(0, 0, 0.1));
  const Surface sphere = MakeSphere(0.05, Vec3d::Zero());
  const std::vector<Vec3d> points = Positions(SampleSurface(sphere, 500));
  const NearestSurface nearest(sphere, SampleSurface(sphere, 5000));
  const AlignedTrajectory run = Align(made.truth, made.estimates);
  const PoseMetrics by_surface =
      EvaluatePoses(run, points, [&](const Vec3d& x) { return nearest.Find(x).distance; });
  EXPECT_LT(by_surface.frames[1].add_s_m, 2e-5);
  EXPECT_GT(EvaluatePoses(run, points).frames[1].add_s_m, 5e-4) << "their spacing";
  EXPECT_GT(by_surface.frames[1].add_m, 2e-3);
}

TEST(PoseMetricsTest, MissingFrames_LowerTheAucButNotTheMean) {
  MadeUpRun made = MakeRun(10);
  made.estimates.rows.resize(6);
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  EXPECT_NEAR(m.add_auc, 0.6, 1e-12);
  EXPECT_NEAR(m.add_m.mean, 0.0, 1e-12);
  EXPECT_EQ(m.add_m.count, 6U);
}

TEST(PoseMetricsTest, VelocityErrors_AreMeasuredPerFrame) {
  MadeUpRun made = MakeRun(4);
  for (EstimateRow& row : made.estimates.rows) row.twist.linear_mps += Vec3d(0.03, 0.04, 0.0);
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  EXPECT_NEAR(m.linear_mps.rms, 0.05, 1e-12);
  EXPECT_NEAR(m.angular_rps.rms, 0.0, 1e-12);
}

TEST(PoseMetricsTest, AddAuc_IsTheMeanOfWhatEveryFrameLacksToTheLimit) {
  // ADD of 0, 25, 50 and 200 mm: integrating the share of frames below d up to 100 mm gives
  // (1 + 0.75 + 0.5 + 0) / 4.
  MadeUpRun made = MakeRun(4);
  const double offsets_m[] = {0.0, 0.025, 0.05, 0.2};
  for (std::size_t k = 0; k < 4; ++k) {
    EstimatedPose& T_co = made.estimates.rows[k].T_co;
    T_co = EstimatedPose(Mat3d(T_co.rotation()),
                         Vec3d(T_co.translation() + Vec3d(0, offsets_m[k], 0)));
  }
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  EXPECT_NEAR(m.add_auc, 0.5625, 1e-12);
  EXPECT_NEAR(m.translation_m.rms, std::sqrt((0.025 * 0.025 + 0.05 * 0.05 + 0.2 * 0.2) / 4), 1e-12);
}

TEST(PoseMetricsTest, VelocityOfAWronglyPlacedOrigin_IsComparedAtTheTrueOne) {
  // The body spins about its true origin; the estimate puts that origin 0.1 m off along x and
  // says, truthfully, how the point there moves.
  MadeUpRun made = MakeRun(2);
  const Vec3d spin_rps(0, 0, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    made.truth.T_ct[k] = TruePose(Mat3d::Identity(), Vec3d(0, 0, 1));
    made.truth.twists[k] = {Vec3d::Zero(), spin_rps};
    EstimateRow& row = made.estimates.rows[k];
    row.T_co = EstimatedPose(Mat3d::Identity(), Vec3d(0.1 * double(k), 0, 1));
    row.twist = {spin_rps.cross(Vec3d(0.1 * double(k), 0, 0)), spin_rps};
  }
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  EXPECT_NEAR(m.frames[1].translation_m, 0.1, 1e-12);
  EXPECT_NEAR(m.frames[1].linear_mps, 0.0, 1e-12);
}

TEST(PoseMetricsTest, FalseTracking_IsTheLongestStretchThatClaimsToTrack) {
  MadeUpRun made = MakeRun(12);
  const char* const states[] = {"tracking", "tracking", "lost",     "tracking",
                                "tracking", "tracking", "tracking", "degraded",
                                "tracking", "tracking", "tracking", "tracking"};
  for (std::size_t k = 0; k < 12; ++k) {
    EstimateRow& row = made.estimates.rows[k];
    row.state = states[k];
    const double off_m = k == 0 || k == 10 ? 0.0 : 0.021;
    row.T_co = EstimatedPose(Mat3d(row.T_co.rotation()),
                             Vec3d(row.T_co.translation() + Vec3d(off_m, 0, 0)));
  }
  const PoseMetrics m = EvaluatePoses(Align(made.truth, made.estimates), CuboidCorners());
  EXPECT_EQ(m.longest_false_tracking, 4U)
      << "frames 3 to 6; the others are lost, degraded or right";
}

}  // namespace
}  // namespace disflow::apps
