// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "child_process.h"
#include "endless_run.h"
#include "estimate_csv.h"
#include "resource_limit.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

/// What a run leaves behind that ends otherwise than it was meant to.
using SuddenEnd = ScratchFolderTest;

TEST_F(SuddenEnd, Killed_RecordingReplaysEveryFrameThatIsListed) {
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kEndlessSensor, "--headless", "--record", Path("recorded")},
                     scratch());
  AwaitLines(Path("recorded/data.txt"), 5);
  track.Signal(SIGKILL);
  EXPECT_EQ(track.Wait().exit_status, -SIGKILL);

  const std::string stamps = ReadFile(Path("recorded/data.txt"));
  const auto listed = static_cast<std::size_t>(std::count(stamps.begin(), stamps.end(), '\n'));
  const Outcome replay =
      RunTrack({"--sensor", "replay:" + Path("recorded"), "--csv", Path("again.csv")}, scratch());
  EXPECT_EQ(replay.exit_status, 0) << replay.err;
  const std::size_t replayed = apps::LoadEstimates(Path("again.csv"), 30000).rows.size();
  EXPECT_GE(replayed, listed);
  EXPECT_LE(replayed, listed + 1) << "whole but for its line feed";
}

#if defined(DISFLOW_HAS_BAG_RECORDING)
constexpr const char* kDepth = "?depth=/disflow/depth/image_rect_raw";

TEST_F(SuddenEnd, Killed_MessagesThatWereRecordedPlay) {
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kEndlessSensor, "--headless", "--record", Path("run.mcap"),
                      "--csv", Path("run.csv")},
                     scratch());
  AwaitLines(Path("run.csv"), 8);
  track.Signal(SIGKILL);
  EXPECT_EQ(track.Wait().exit_status, -SIGKILL);
  const Outcome replay = RunTrack(
      {"--sensor", "rosbag:" + Path("run.mcap") + kDepth, "--csv", Path("again.csv")}, scratch());
  EXPECT_EQ(replay.exit_status, 0) << replay.err;
  EXPECT_NE(replay.err.find("cut short"), std::string::npos) << replay.err;
  EXPECT_GE(apps::LoadEstimates(Path("again.csv"), 30000).rows.size(), 6U);
}

TEST_F(SuddenEnd, FileOfMessagesThatMayNotGrowFurther_KeepsItsWholeFrames) {
  Outcome outcome;
  {
    const ResourceLimit limit(RLIMIT_FSIZE, 3'000'000);  // of images of 900 KB
    outcome = RunTrack(
        {"--sensor", "sim:bottle?frames=6", "--record", Path("run.mcap"), "--headless"}, scratch());
  }
  EXPECT_EQ(outcome.exit_status, 4);
  EXPECT_NE(outcome.err.find("nothing more is recorded after "), std::string::npos) << outcome.err;
  const Outcome replay = RunTrack(
      {"--sensor", "rosbag:" + Path("run.mcap") + kDepth, "--csv", Path("again.csv")}, scratch());
  EXPECT_EQ(replay.exit_status, 0) << replay.err;
  EXPECT_GE(apps::LoadEstimates(Path("again.csv"), 6).rows.size(), 1U);
}
#endif

TEST_F(SuddenEnd, RecordingThatWasCutShort_IsReplayedWithAWord) {
  ASSERT_EQ(RunTrack({"--sensor", "sim:bottle?frames=4", "--record", Path("recorded")}, scratch())
                .exit_status,
            0);
  const fs::path stamps = Path("recorded/data.txt");
  fs::resize_file(stamps, fs::file_size(stamps) - 3);
  const Outcome replay =
      RunTrack({"--sensor", "replay:" + Path("recorded"), "--csv", Path("again.csv")}, scratch());
  EXPECT_EQ(replay.exit_status, 0) << replay.err;
  EXPECT_NE(replay.err.find("recorded: the recording was cut short and ends with frame 2; left "
                            "out: "),
            std::string::npos)
      << replay.err;
  EXPECT_EQ(apps::LoadEstimates(Path("again.csv"), 4).rows.size(), 3U);
}

TEST_F(SuddenEnd, FileThatMayNotGrowFurther_EndsTheRecordingAndNotTheRun) {
  Outcome outcome;
  {
    const ResourceLimit limit(RLIMIT_FSIZE, 10000);  // less than an image
    outcome =
        RunTrack({"--sensor", "sim:bottle?frames=10", "--record", Path("recorded")}, scratch());
  }
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("0.float: cannot be written"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("nothing more is recorded after 0 frames"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("10 frames"), std::string::npos) << outcome.err;
}

TEST_F(SuddenEnd, StartedAgainAndAgain_EveryRunIsRecordedInAFolderOfItsOwn) {
  const Arguments arguments = {
      "--sensor", kEndlessSensor,         "--headless", "--csv",         Path("run-{n}.csv"),
      "--record", Path("recordings/{n}"), "--flow",     Path("flow-{n}")};
  for (const char* number : {"000001", "000002", "000003"}) {
    ChildProcess track(DISFLOW_TRACK, arguments, scratch());
    AwaitLines(Path("recordings/" + std::string(number) + "/data.txt"), 3);
    track.Signal(SIGKILL);
    EXPECT_EQ(track.Wait().exit_status, -SIGKILL);
  }
  for (const char* number : {"000001", "000002", "000003"}) {
    const Outcome replay =
        RunTrack({"--sensor", "replay:" + Path("recordings/" + std::string(number)), "--headless"},
                 scratch());
    EXPECT_EQ(replay.exit_status, 0) << replay.err;
    EXPECT_TRUE(fs::exists(Path("run-" + std::string(number) + ".csv")));
    EXPECT_TRUE(fs::exists(Path("flow-" + std::string(number) + "/000000.ply")));
  }
}

TEST_F(SuddenEnd, RecordingIntoAFolderThatHasOne_IsRefusedWithAWayOut) {
  const Arguments arguments = {"--sensor", "sim:bottle?frames=2", "--record", Path("recorded")};
  ASSERT_EQ(RunTrack(arguments, scratch()).exit_status, 0);
  const Outcome again = RunTrack(arguments, scratch());
  EXPECT_EQ(again.exit_status, 4);
  EXPECT_NE(again.err.find("recorded: is not empty, and a recording is never overwritten"),
            std::string::npos)
      << again.err;
  EXPECT_NE(again.err.find("put {n} into its name"), std::string::npos) << again.err;
}

class UnexpectedSignal : public SuddenEnd, public testing::WithParamInterface<int> {};

TEST_P(UnexpectedSignal, LeavesNoPartOfAFile) {
  WriteFile(Path("run.ply"), "earlier\n");
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kEndlessSensor, "--headless", "--csv", Path("run.csv"), "--mesh",
                      Path("run.ply"), "--mesh-picture", Path("run.png"), "--flow", Path("flow")},
                     scratch());
  AwaitLines(Path("run.csv"), 5);
  track.Signal(GetParam());
  EXPECT_EQ(track.Wait().exit_status, -GetParam());
  EXPECT_EQ(ReadFile(Path("run.ply")), "earlier\n");
  for (const fs::directory_entry& entry : fs::directory_iterator(scratch()))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

INSTANTIATE_TEST_SUITE_P(Output, UnexpectedSignal, testing::Values(SIGUSR1, SIGALRM, SIGKILL),
                         [](const testing::TestParamInfo<int>& test) {
                           return std::string(test.param == SIGUSR1   ? "User1"
                                              : test.param == SIGALRM ? "Alarm"
                                                                      : "Kill");
                         });

}  // namespace
}  // namespace disflow::test
