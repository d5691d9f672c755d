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
constexpr double kEndDistance_m = 0.02;
constexpr double kEndAngle_deg = 1.0;

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

struct Difference {
  double distance_m;
  double angle_deg;
};

Difference Between(const Pose& a, const Pose& b) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(a.linear().transpose() * b.linear()));
  return {(b.translation() - a.translation()).norm(), turn.angle() * kDegreesPerRadian};
}

class RoomTracking : public ScratchFolderTest {};

TEST_F(RoomTracking, CameraMotionThroughAStaticRoom_MatchesTheGivenPosesAndTheRoomStandsStill) {
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
  Pose T_w_o_previous = T_w_c0 * T_c0_o;
  int jumps = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const apps::EstimateRow& row = rows[static_cast<std::size_t>(frame)];
    EXPECT_EQ(row.status, "ok") << "frame " << frame;
    // The object stands still, so that its motion seen from the camera is the camera's.
    const Pose given = T_w_c0.inverse() * GivenPose(room, frame);
    const Difference error = Between(given, T_c0_o * EstimatedPoseOf(row).inverse());
    const bool is_end_point = frame == kFrames - 1;
    EXPECT_LE(error.distance_m, is_end_point ? kEndDistance_m : 0.08) << "frame " << frame;
    EXPECT_LE(error.angle_deg, is_end_point ? kEndAngle_deg : 3.0) << "frame " << frame;
    if (is_end_point)
      std::printf("end point: %.1f mm, %.2f deg\n", 1e3 * error.distance_m, error.angle_deg);
    const Pose T_w_o = GivenPose(room, frame) * EstimatedPoseOf(row);
    const Difference step = Between(T_w_o_previous, T_w_o);
    if (step.distance_m > 0.01 || step.angle_deg > 0.6) ++jumps;
    T_w_o_previous = T_w_o;
  }
  // The reference itself jumps by 36 mm from frame 121 to 122, which the images contradict
  // (docs/results.md).
  EXPECT_LE(jumps, 1) << "the object does not stand still in the world";
}

}  // namespace
}  // namespace disflow::test
