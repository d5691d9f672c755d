// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory.h"

#include <gtest/gtest.h>

#include "errors.h"
#include "run_builder.h"
#include "scratch_dir.h"

namespace disflow::apps {
namespace {

TEST(AlignTest, PerfectTrackerWithItsOwnFrame_MatchesTheTruthInEveryFrame) {
  const MadeUpRun made = MakeRun(50);
  const AlignedTrajectory run = Align(made.truth, made.estimates);
  ASSERT_EQ(run.frames.size(), 50U);
  EXPECT_EQ(run.aligned_frame, 0);
  EXPECT_EQ(run.missing(), 0U);
  EXPECT_EQ(run.stamp_mismatches, 0U);
  EXPECT_TRUE((run.T_ot * made.T_ot.Inverse()).Log().isZero(1e-12));
  for (const AlignedFrame& frame : run.frames) {
    EXPECT_TRUE((frame.T_ct_estimated * frame.T_ct.Inverse()).Log().isZero(1e-12));
    EXPECT_TRUE(frame.twist_estimated.linear_mps.isApprox(frame.twist.linear_mps, 1e-12));
    EXPECT_EQ(frame.twist_estimated.angular_rps, frame.twist.angular_rps);
  }
}

TEST(AlignTest, VelocityOfAnOffsetOrigin_IsMovedByTheCrossProduct) {
  // Spinning about z at 2 rad/s: a point 0.1 m along x moves at 0.2 m/s along y.
  MadeUpRun made = MakeRun(1);
  made.truth.T_ct[0] = TruePose(Mat3d::Identity(), Vec3d(0.1, 0.0, 1.0));
  made.estimates.rows[0].T_co = EstimatedPose(Mat3d::Identity(), Vec3d(0.0, 0.0, 1.0));
  made.estimates.rows[0].twist = {Vec3d(1.0, 0.0, 0.0), Vec3d(0.0, 0.0, 2.0)};
  const AlignedTrajectory run = Align(made.truth, made.estimates);
  EXPECT_TRUE(run.frames[0].twist_estimated.linear_mps.isApprox(Vec3d(1.0, 0.2, 0.0), 1e-12));
}

TEST(AlignTest, FirstFramesWithoutPose_MoveTheAlignmentAndCountAsMissing) {
  MadeUpRun made = MakeRun(10);
  for (EstimateRow& row : made.estimates.rows) row.status = "ok";
  made.estimates.rows[0].status = "no usable depth";
  made.estimates.rows[0].T_co = EstimatedPose();
  made.estimates.rows.erase(made.estimates.rows.begin() + 5);
  const AlignedTrajectory run = Align(made.truth, made.estimates);
  EXPECT_EQ(run.aligned_frame, 1);
  EXPECT_EQ(run.frames.size(), 8U);
  EXPECT_EQ(run.missing(), 2U);
  EXPECT_TRUE((run.frames[7].T_ct_estimated * run.frames[7].T_ct.Inverse()).Log().isZero(1e-12));
}

TEST(AlignTest, LostRows_AreKeptAndCounted) {
  MadeUpRun made = MakeRun(10);
  for (EstimateRow& row : made.estimates.rows) row.status = "ok";
  made.estimates.rows[4].status = "registration failed";
  made.estimates.rows[5].state = "lost";
  const AlignedTrajectory run = Align(made.truth, made.estimates);
  EXPECT_EQ(run.frames.size(), 10U);
  EXPECT_EQ(run.lost, 2U);
}

TEST(AlignTest, NoRowWithAPose_IsRefused) {
  MadeUpRun made = MakeRun(2);
  for (EstimateRow& row : made.estimates.rows) row.status = "bad";
  EXPECT_FALSE(MessageOf<InputError>([&] { (void)Align(made.truth, made.estimates); }).empty());
}

TEST(AlignTest, StampsOfAnotherSequence_AreCounted) {
  MadeUpRun made = MakeRun(10);
  for (EstimateRow& row : made.estimates.rows) row.timestamp_s *= 2.0;
  EXPECT_EQ(Align(made.truth, made.estimates).stamp_mismatches, 9U);
}

}  // namespace
}  // namespace disflow::apps
