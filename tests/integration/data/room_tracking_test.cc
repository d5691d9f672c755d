// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <fstream>

#include "child_process.h"
#include "estimate_csv.h"
#include "scratch_folder.h"
#include "test_data.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;
using Pose = Eigen::Isometry3d;

constexpr int kFrames = 150;
constexpr double kDegreesPerRadian = 57.29577951308232;

/// Camera to world, as the recording gives it.
Pose GivenPose(const fs::path& folder, int frame) {
  char name[40];
  (void)std::snprintf(name, sizeof(name), "frame-%06d.pose.txt", frame);
  std::ifstream file(folder / "pose" / name);
  Eigen::Matrix3d rotation;
  Pose pose = Pose::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) file >> rotation(row, column);
    file >> pose.translation()[row];
  }
  EXPECT_TRUE(file.good()) << name;
  // The files carry seven digits, too few for an orthogonal matrix.
  pose.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  return pose;
}

Pose EstimatedPoseOf(const apps::EstimateRow& row) {
  Pose T_co = Pose::Identity();
  T_co.linear() = row.T_co.rotation();
  T_co.translation() = row.T_co.translation();
  return T_co;
}

class RoomTracking : public ScratchFolderTest {};

TEST_F(RoomTracking, CameraMotionThroughAStaticRoom_MatchesTheGivenPoses) {
  const fs::path room = TestData("kinect_room");
  DISFLOW_SKIP_WITHOUT(room);
  const Outcome outcome = RunTrack(
      {"--sensor", "replay:" + room.string() + "?mask=none", "--profile", "dense", "--config",
       DISFLOW_ROOM_SETTINGS, "--csv", Path("room.csv"), "--mesh", Path("room.ply"), "--headless"},
      scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const std::vector<apps::EstimateRow> rows = apps::LoadEstimates(Path("room.csv"), kFrames).rows;
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(kFrames));

  const Pose T_w_c0 = GivenPose(room, 0);
  const Pose T_c0_o = EstimatedPoseOf(rows.front());
  for (int frame = 0; frame < kFrames; ++frame) {
    const apps::EstimateRow& row = rows[static_cast<std::size_t>(frame)];
    EXPECT_EQ(row.status, "ok") << "frame " << frame;
    // The object stands still, so that its motion seen from the camera is the camera's.
    const Pose estimated = T_c0_o * EstimatedPoseOf(row).inverse();
    const Pose given = T_w_c0.inverse() * GivenPose(room, frame);
    const double distance_m = (estimated.translation() - given.translation()).norm();
    const Eigen::AngleAxisd turn(Eigen::Matrix3d(given.linear().transpose() * estimated.linear()));
    const bool is_end_point = frame == kFrames - 1;
    EXPECT_LE(distance_m, is_end_point ? 0.03 : 0.08) << "frame " << frame;
    EXPECT_LE(turn.angle() * kDegreesPerRadian, is_end_point ? 1.5 : 3.0) << "frame " << frame;
  }
}

}  // namespace
}  // namespace disflow::test
