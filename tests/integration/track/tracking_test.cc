// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "child_process.h"
#include "estimate_csv.h"
#include "evaluation.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

/// What is to be simulated and how well it must at least be tracked.
struct Scene {
  const char* name;
  const char* object;
  const char* motion;
  const char* noise;
  double least_add_s_auc;  ///< ADD-S: a doughnut looks the same from all around.
};

void PrintTo(const Scene& scene, std::ostream* stream) { *stream << scene.name; }

class SimulatedScene : public ScratchFolderTest, public testing::WithParamInterface<Scene> {};

TEST_P(SimulatedScene, IsTracked) {
  const Scene& scene = GetParam();
  const Outcome simulated =
      RunSim({Path("sequence"), "--object", scene.object, "--motion", scene.motion, "--noise",
              scene.noise, "--seed", "1", "--frames", "60"},
             scratch());
  ASSERT_EQ(simulated.exit_status, 0) << simulated.err;
  const Outcome tracked = RunTrack({"--sensor", "replay:" + Path("sequence") + "?mask=gt", "--csv",
                                    Path("run.csv"), "--mesh", Path("run.ply"), "--headless"},
                                   scratch());
  ASSERT_EQ(tracked.exit_status, 0) << tracked.err;
  const apps::Report report = apps::Evaluate(
      {.sequence = Path("sequence"), .csv = Path("run.csv"), .model = {}, .mesh = Path("run.ply")});
  EXPECT_GE(report.poses.add_s_auc, scene.least_add_s_auc);
  ASSERT_TRUE(report.surface.has_value());
}

INSTANTIATE_TEST_SUITE_P(Tracking, SimulatedScene,
                         testing::Values(Scene{"BottleFastClean", "bottle", "fast", "clean", 0.97},
                                         Scene{"BoxFastWhite", "box", "fast", "white", 0.95},
                                         Scene{"DoughnutModerateWhite", "doughnut", "moderate",
                                               "white", 0.95}),
                         [](const testing::TestParamInfo<Scene>& test) { return test.param.name; });

class TrackingTest : public ScratchFolderTest {};

TEST_F(TrackingTest, TwoRunsOfOneReplay_GiveTheSameBytes) {
  const Outcome recorded = RunTrack(
      {"--sensor", "sim:box?motion=fast&noise=white&frames=40", "--record", Path("recorded")},
      scratch());
  ASSERT_EQ(recorded.exit_status, 0) << recorded.err;
  for (const char* run : {"a", "b"}) {
    const Outcome outcome = RunTrack(
        {"--sensor", "replay:" + Path("recorded"), "--csv", Path(std::string(run) + ".csv"),
         "--mesh", Path(std::string(run) + ".ply"), "--no-timing", "--headless"},
        scratch());
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  }
  EXPECT_EQ(ReadFile(Path("a.csv")), ReadFile(Path("b.csv")));
  EXPECT_EQ(ReadFile(Path("a.ply")), ReadFile(Path("b.ply")));
  EXPECT_FALSE(ReadFile(Path("a.ply")).empty());
}

#if defined(DISFLOW_HAS_BAG_RECORDING)
TEST_F(TrackingTest, FileOfMessages_PlaysByItsNameAlone) {
  const std::string file = Path("run_12:30.mcap");  // a colon as after a scheme
  ASSERT_EQ(RunTrack({"--sensor", "sim:box?motion=fast&noise=white&mask=none&frames=10", "--record",
                      file, "--csv", Path("run.csv"), "--no-timing"},
                     scratch())
                .exit_status,
            0);
  const Outcome again =
      RunTrack({"--sensor", file, "--csv", Path("again.csv"), "--no-timing"}, scratch());
  ASSERT_EQ(again.exit_status, 0) << again.err;
  EXPECT_NE(again.err.find("its depth images are those of /disflow/depth/image_rect_raw"),
            std::string::npos)
      << again.err;
  EXPECT_EQ(ReadFile(Path("again.csv")), ReadFile(Path("run.csv")));
  ASSERT_EQ(
      RunTrack({"--sensor", file + "?count=3", "--csv", Path("part.csv")}, scratch()).exit_status,
      0);
  EXPECT_EQ(apps::LoadEstimates(Path("part.csv"), 3).rows.size(), 3U);
  const Outcome nowhere = RunTrack({"--sensor", Path("nowhere.mcap")}, scratch());
  EXPECT_EQ(nowhere.exit_status, 3);
  EXPECT_NE(nowhere.err.find("nowhere.mcap: No such file or directory"), std::string::npos)
      << nowhere.err;
}
#endif

TEST_F(TrackingTest, RecordedFrames_ReplayToTheSameTrajectory) {
  const Outcome live =
      RunTrack({"--sensor", "sim:box?motion=fast&noise=white&frames=20", "--record",
                Path("recorded"), "--csv", Path("live.csv"), "--no-timing"},
               scratch());
  ASSERT_EQ(live.exit_status, 0) << live.err;
  const Outcome replay = RunTrack(
      {"--sensor", "replay:" + Path("recorded"), "--csv", Path("replay.csv"), "--no-timing"},
      scratch());
  ASSERT_EQ(replay.exit_status, 0) << replay.err;
  EXPECT_EQ(ReadFile(Path("live.csv")), ReadFile(Path("replay.csv")));
}

TEST_F(TrackingTest, EveryInputFrame_GivesOneRow) {
  const Outcome outcome =
      RunTrack({"--sensor", "sim:can?frames=25", "--csv", Path("run.csv")}, scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const apps::EstimateTable table = apps::LoadEstimates(Path("run.csv"), 25);
  ASSERT_EQ(table.rows.size(), 25U);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.rows[i].frame, static_cast<int>(i));
    EXPECT_TRUE(table.rows[i].pose_covariance.has_value());
    EXPECT_TRUE(table.rows[i].twist_covariance.has_value());
  }
  for (const char* stage :
       {"segment", "sample", "register", "filter", "fuse", "retrain", "total"}) {
    EXPECT_TRUE(table.FindStage(stage).has_value()) << stage;
  }
}

TEST_F(TrackingTest, FramesLimit_EndsTheRun) {
  const Outcome outcome = RunTrack({"--sensor", "sim:can?frames=25", "--frames", "7", "--csv",
                                    Path("run.csv"), "--rate", "realtime"},
                                   scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(apps::LoadEstimates(Path("run.csv"), 25).rows.size(), 7U);
}

TEST_F(TrackingTest, EveryProfile_Tracks) {
  for (const char* profile : {"micro", "edge", "dense"}) {
    const Outcome outcome = RunTrack({"--sensor", "sim:bottle?frames=10&width=240&height=180",
                                      "--profile", profile, "--csv", Path("run.csv")},
                                     scratch());
    EXPECT_EQ(outcome.exit_status, 0) << profile << ": " << outcome.err;
    EXPECT_EQ(apps::LoadEstimates(Path("run.csv"), 10).rows.back().status, "ok") << profile;
  }
}

}  // namespace
}  // namespace disflow::test
