// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "child_process.h"
#include "estimate_csv.h"
#include "eventually.h"
#include "said_number.h"
#include "scratch_folder.h"
#include "service_manager.h"

namespace disflow::test {
namespace {

class LiveTest : public ScratchFolderTest {};

TEST_F(LiveTest, FramesFasterThanTheTracker_AreDroppedAndCounted) {
  constexpr int kFrames = 200;
  const Outcome outcome =
      RunTrack({"--sensor", "sim:box?fps=1000&frames=" + std::to_string(kFrames), "--rate", "live",
                "--csv", Path("run.csv")},
               scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const auto rows = apps::LoadEstimates(Path("run.csv"), kFrames).rows;
  const int dropped = NumberBefore(outcome.err, "frames dropped");
  EXPECT_GE(rows.size(), 1U);
  EXPECT_EQ(static_cast<int>(rows.size()) + dropped, kFrames) << outcome.err;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_GT(rows[i].timestamp_s, rows[i - 1].timestamp_s);
  }
}

TEST_F(LiveTest, PaceOfTheStamps_ChangesNothingAndDropsNothing) {
  const std::string sensor = "sim:box?motion=fast&noise=white&frames=20";
  for (const char* rate : {"max", "realtime"}) {
    const Outcome outcome = RunTrack({"--sensor", sensor, "--rate", rate, "--csv",
                                      Path(std::string(rate) + ".csv"), "--no-timing"},
                                     scratch());
    ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
    EXPECT_EQ(NumberBefore(outcome.err, "frames dropped"), 0) << outcome.err;
  }
  EXPECT_EQ(ReadFile(Path("max.csv")), ReadFile(Path("realtime.csv")));
}

TEST_F(LiveTest, RefusedRequests_AreSaidAndTheRunGoesOn) {
  const Outcome outcome = RunTrack(
      {"--sensor", "sim:box?frames=5", "--rate", "live", "--cpu", "1000,1001", "--lock-memory"},
      scratch());
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("tracking thread: processor 1000"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("capture thread: processor 1001"), std::string::npos) << outcome.err;
}

TEST_F(LiveTest, StopSignal_EndsALiveRunWithEverythingWritten) {
  ChildProcess track(
      DISFLOW_TRACK,
      {"--sensor", "sim:box?frames=3000", "--rate", "live", "--csv", Path("run.csv")}, scratch());
  constexpr std::size_t kSomeRows_bytes = 4000;
  ASSERT_TRUE(Eventually([&] { return ReadFile(Path("run.csv")).size() >= kSomeRows_bytes; }));
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("with a measured pose"), std::string::npos);
  EXPECT_EQ(ReadFile(Path("run.csv")).back(), '\n');
}

class ServiceTest : public ScratchFolderTest {
 protected:
  ServiceTest() { manager_.StartWatchdog(900'000); }
  const ServiceManager manager_{Path("notify")};
};

TEST_F(ServiceTest, ServiceManager_IsToldOfStartLifeStateAndEnd) {
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", "sim:box?frames=30", "--rate", "live", "--headless"}, scratch());
  // Read while it runs: the socket holds ten messages, and a slow run sends more.
  Arguments messages;
  ASSERT_TRUE(Eventually([&] {
    for (const std::string& message : manager_.Received()) messages.push_back(message);
    return !messages.empty() && messages.back() == "STOPPING=1";
  }));
  const Outcome outcome = track.Wait();
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  ASSERT_GE(messages.size(), 4U);
  EXPECT_EQ(messages.front(), "READY=1");
  EXPECT_EQ(messages.back(), "STOPPING=1");
  EXPECT_GE(std::count(messages.begin(), messages.end(), "WATCHDOG=1"), 2);
  EXPECT_TRUE(std::any_of(messages.begin(), messages.end(),
                          [](const std::string& m) { return m.starts_with("STATUS="); }));
}

TEST_F(ServiceTest, StartThatFails_IsNeverCalledReady) {
  EXPECT_NE(RunTrack({"--sensor", "replay:/nonexistent"}, scratch()).exit_status, 0);
  EXPECT_TRUE(manager_.Received().empty());
}

class RunFileTest : public ScratchFolderTest {};

TEST_F(RunFileTest, WholeCommandLineInTheFile_GivesTheSameRun) {
  const std::string sensor = "sim:bottle?motion=fast&noise=white&frames=15&width=240&height=180";
  const Outcome typed =
      RunTrack({"--sensor", sensor, "--csv", Path("typed.csv"), "--no-timing", "--range", "0.2,1.5",
                "--profile", "micro", "--set", "registration.iterations=7"},
               scratch());
  ASSERT_EQ(typed.exit_status, 0) << typed.err;
  WriteFile(Path("run.toml"), "[run]\nsensor = \"" + sensor + "\"\ncsv = \"" + Path("filed.csv") +
                                  "\"\nno_timing = true\nheadless = false\nrange = [0.2, 1.5]\n"
                                  "profile = \"micro\"\n[registration]\niterations = 7\n");
  const Outcome filed = RunTrack({"--config", Path("run.toml")}, scratch());
  ASSERT_EQ(filed.exit_status, 0) << filed.err;
  EXPECT_EQ(ReadFile(Path("typed.csv")), ReadFile(Path("filed.csv")));
  EXPECT_FALSE(ReadFile(Path("typed.csv")).empty());
}

TEST_F(RunFileTest, WhatIsTyped_WinsOverTheFile) {
  WriteFile(Path("run.toml"), "[run]\nsensor = \"sim:box?frames=50\"\nframes = 40\n");
  const Outcome outcome = RunTrack({"--config", Path("run.toml"), "--frames", "3"}, scratch());
  EXPECT_EQ(outcome.exit_status, 0);
  EXPECT_NE(outcome.err.find("3 frames in"), std::string::npos) << outcome.err;
}

TEST_F(RunFileTest, SenselessLine_IsNamedWithFileAndLine) {
  for (const char* line :
       {"sensr = \"sim:box\"", "rate = \"fast\"", "frames = -3", "frames = {}", "config = \"x\"",
        "help = true", "cpu = [1, 2, 3, 4, 5, 6]", "roi = [1, 2]", "sensor = [[1]]", "= 3"}) {
    WriteFile(Path("run.toml"), std::string("[run]\n") + line + "\n");
    const Outcome outcome = RunTrack({"--config", Path("run.toml")}, scratch());
    EXPECT_EQ(outcome.exit_status, 2) << line;
    EXPECT_NE(outcome.err.find("run.toml:2"), std::string::npos) << line << ": " << outcome.err;
  }
}

#ifdef DISFLOW_COUNT_ALLOCATIONS
/// Calls of malloc and its kin in a whole run.
long AllocationsOf(const Arguments& arguments, const std::filesystem::path& scratch) {
  const std::string file = scratch / "allocations";
  ::setenv("DISFLOW_ALLOCATIONS", file.c_str(), 1);
  ::setenv("LD_PRELOAD", DISFLOW_COUNT_ALLOCATIONS, 1);
  const Outcome outcome = RunTrack(arguments, scratch);
  ::unsetenv("LD_PRELOAD");
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  return std::strtol(ReadFile(file).c_str(), nullptr, 10);
}

TEST_F(LiveTest, FourTimesAsManyFrames_TakeNoMoreAllocations) {
  // The closing report has texts of other lengths from run to run: some strings more or less. One
  // allocation per frame would be 180.
  constexpr double kStringsOfTheReport = 60.0;
  // The same camera, so that its own preparations are the same; in one thread and in two.
  for (const char* rate : {"max", "live"}) {
    const auto run = [&](int frames) {
      return AllocationsOf(
          {"--sensor", "sim:box?motion=fast&noise=white&fps=300&frames=240", "--rate", rate,
           "--frames", std::to_string(frames), "--headless", "--link", "udp://127.0.0.1:9", "--csv",
           "/dev/null", "--mask-stream", "/disflow-nobody-writes"},
          scratch());
    };
    const long few = run(60);
    EXPECT_GT(few, 100) << "the counter counts nothing";
    EXPECT_NEAR(static_cast<double>(run(240)), static_cast<double>(few), kStringsOfTheReport)
        << rate;
  }
}

TEST_F(LiveTest, FourTimesAsManyFramesOfTwoObjects_TakeNoMoreAllocations) {
  constexpr double kStringsOfTheReport = 60.0;
  const auto run = [&](int frames) {
    return AllocationsOf(
        {"--sensor", "sim:box+bottle?noise=white&frames=240", "--threads", "2", "--object",
         "name=box,label=1", "--object", "name=bottle,label=2", "--frames", std::to_string(frames),
         "--headless", "--link", "udp://127.0.0.1:9", "--csv", Path("run.csv")},
        scratch());
  };
  const long few = run(60);
  EXPECT_GT(few, 100) << "the counter counts nothing";
  EXPECT_NEAR(static_cast<double>(run(240)), static_cast<double>(few), kStringsOfTheReport);
}
#endif

}  // namespace
}  // namespace disflow::test
