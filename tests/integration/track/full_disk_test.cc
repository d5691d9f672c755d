// SPDX-License-Identifier: BSD-3-Clause
// Disks that are really full: what was written stays whole, tracking goes on, and it is said.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "endless_run.h"
#include "estimate_csv.h"
#include "ply_file.h"
#include "small_disk.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

class FullDisk : public ScratchFolderTest {
 protected:
  /// @return false: the test cannot be run.
  [[nodiscard]] bool Mount(const std::string& options) {
    disk_.emplace(options, scratch());
    return disk_->refusal().empty();
  }
  [[nodiscard]] Outcome Track(Arguments outputs, const std::string& frames = "20") const {
    outputs.insert(outputs.begin(), {"--sensor", "sim:bottle?frames=" + frames, "--headless"});
    return RunTrack(outputs, scratch());
  }
  [[nodiscard]] std::size_t FramesOf(const std::string& sensor) const {
    const Outcome replay = RunTrack({"--sensor", sensor, "--csv", Path("again.csv")}, scratch());
    EXPECT_EQ(replay.exit_status, 0) << replay.err;
    return apps::LoadEstimates(Path("again.csv"), 30000).rows.size();
  }
  static void ExpectSaid(const Outcome& outcome, const std::string& frames) {
    EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("No space left on device"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(frames + " frames in"), std::string::npos)
        << "tracking goes on: " << outcome.err;
  }
  [[nodiscard]] std::set<std::string> NamesOnDisk() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(disk_->path()))
      names.insert(entry.path().filename());
    return names;
  }

  std::optional<SmallDisk> disk_;
};

TEST_F(FullDisk, RecordingAndTrajectory_EndWithWholeFramesAndRows) {
  if (!Mount("size=3m")) GTEST_SKIP() << disk_->refusal();
  const Outcome outcome = Track({"--record", disk_->Path("rec"), "--csv", disk_->Path("run.csv")});
  ExpectSaid(outcome, "20");
  EXPECT_GE(FramesOf("replay:" + disk_->Path("rec")), 2U);
  EXPECT_EQ(ReadFile(disk_->Path("run.csv")).back(), '\n');
}

/// Behind the queue.
TEST_F(FullDisk, RecordingOfALiveSensor_EndsWithWholeFrames) {
  if (!Mount("size=3m")) GTEST_SKIP() << disk_->refusal();
  const Outcome outcome = Track({"--rate", "live", "--record", disk_->Path("rec")});
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("No space left on device; nothing more is recorded after "),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find(" frames in"), std::string::npos)
      << "tracking goes on: " << outcome.err;
  EXPECT_GE(FramesOf("replay:" + disk_->Path("rec")), 2U);
}

TEST_F(FullDisk, WithoutNamesForFurtherFiles_RecordingEndsWithWholeFrames) {
  if (!Mount("size=100m,nr_inodes=20")) GTEST_SKIP() << disk_->refusal();
  ExpectSaid(Track({"--record", disk_->Path("rec")}), "20");
  EXPECT_GE(FramesOf("replay:" + disk_->Path("rec")), 2U);
}

#ifdef DISFLOW_HAS_BAG_RECORDING
TEST_F(FullDisk, RecordingOfMessages_EndsWithWholeFrames) {
  if (!Mount("size=3m")) GTEST_SKIP() << disk_->refusal();
  ExpectSaid(Track({"--record", disk_->Path("run.mcap")}), "20");
  EXPECT_GE(FramesOf("rosbag:" + disk_->Path("run.mcap") + "?depth=/disflow/depth/image_rect_raw"),
            1U);
}
#endif

TEST_F(FullDisk, MeshAndFlow_LeaveTheEarlierMeshAndNoPartOfAFile) {
  if (!Mount("size=1m")) GTEST_SKIP() << disk_->refusal();
  WriteFile(disk_->Path("run.ply"), "earlier\n");
  ExpectSaid(Track({"--flow", disk_->Path("flow"), "--mesh", disk_->Path("run.ply")}, "60"), "60");
  EXPECT_EQ(ReadFile(disk_->Path("run.ply")), "earlier\n");
  EXPECT_EQ(NamesOnDisk(), (std::set<std::string>{"flow", "run.ply"}));
  int clouds = 0;
  for (const auto& entry : fs::directory_iterator(disk_->Path("flow"))) {
    EXPECT_EQ(entry.path().extension(), ".ply");
    EXPECT_NO_THROW((void)apps::LoadPly(entry.path()));
    ++clouds;
  }
  EXPECT_GE(clouds, 3);
}

TEST_F(FullDisk, RoomThatComesBack_IsUsedByTheNextFile) {
  if (!Mount("size=1m")) GTEST_SKIP() << disk_->refusal();
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kEndlessSensor, "--rate", "live", "--headless", "--csv",
                      disk_->Path("run-{n}.csv"), "--rotate-age", "0.3"},
                     scratch());
  AwaitLines(disk_->Path("run-000001.csv"), 3);
  disk_->Fill();
  ASSERT_TRUE(Eventually(
      [&] { return track.said().find("No space left on device") != std::string::npos; }));
  disk_->Empty();
  const std::set<std::string> before = NamesOnDisk();
  ASSERT_TRUE(Eventually([&] { return NamesOnDisk().size() >= before.size() + 3; }))
      << track.said();
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  // The last one may just have begun.
  const std::string last = *std::prev(NamesOnDisk().end(), 2);
  EXPECT_GE(apps::LoadEstimates(disk_->Path(last), 30000).rows.size(), 2U) << last;
}

}  // namespace
}  // namespace disflow::test
