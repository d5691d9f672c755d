// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <set>
#include <sstream>

#include "child_process.h"
#include "endless_run.h"
#include "eventually.h"
#include "resource_limit.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

class RotationTest : public ScratchFolderTest {
 protected:
  /// Files and folders whose names begin and end so, sorted.
  [[nodiscard]] std::set<std::string> Names(const std::string& begin,
                                            const std::string& end) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(scratch())) {
      const std::string name = entry.path().filename();
      if (name.starts_with(begin) && name.ends_with(end)) names.insert(name);
    }
    return names;
  }
  /// Headers of all, which have to be the same, are left out but for the first.
  [[nodiscard]] std::string Joined(const std::set<std::string>& files) const {
    std::string joined;
    std::string header;
    for (const std::string& file : files) {
      const std::string text = ReadFile(Path(file));
      const std::size_t rows = text.find('\n') + 1;
      if (joined.empty()) joined = header = text.substr(0, rows);
      EXPECT_EQ(text.substr(0, rows), header) << file;
      joined += text.substr(rows);
    }
    return joined;
  }
  [[nodiscard]] std::ptrdiff_t Rows(const std::set<std::string>& files) const {
    const std::string text = Joined(files);
    return std::count(text.begin(), text.end(), '\n') - 1;
  }
};

constexpr const char* kSensor = "sim:box?noise=white&frames=60";

TEST_F(RotationTest, Trajectory_GoesOnInTheNextFileWithoutLosingARow) {
  ASSERT_EQ(RunTrack({"--sensor", kSensor, "--csv", Path("whole.csv"), "--no-timing"}, scratch())
                .exit_status,
            0);
  const Outcome outcome = RunTrack(
      {"--sensor", kSensor, "--csv", Path("run-{n}.csv"), "--no-timing", "--rotate-size", "0.02"},
      scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const std::set<std::string> parts = Names("run-", ".csv");
  EXPECT_GT(parts.size(), 2U);
  EXPECT_TRUE(parts.contains("run-000001.csv"));
  EXPECT_EQ(Joined(parts), ReadFile(Path("whole.csv")));
  for (const std::string& part : parts) EXPECT_LT(fs::file_size(Path(part)), 22'000U) << part;
}

TEST_F(RotationTest, Age_IsCountedByTheStampsOfTheFrames) {
  // 30 frames a second: 2 s of them, half a second in a file.
  const Outcome outcome = RunTrack(
      {"--sensor", kSensor, "--csv", Path("run-{n}.csv"), "--rotate-age", "0.49"}, scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(Names("run-", ".csv").size(), 4U);
  EXPECT_EQ(Rows(Names("run-", ".csv")), 60);
}

TEST_F(RotationTest, Recordings_AreEachWholeAndTogetherEveryFrame) {
  const Outcome outcome =
      RunTrack({"--sensor", "sim:box?noise=white&frames=30", "--csv", Path("run-{n}.csv"),
                "--record", Path("rec-{n}"), "--rotate-age", "0.3"},
               scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const std::set<std::string> parts = Names("rec-", "");
  EXPECT_EQ(parts.size(), Names("run-", ".csv").size());
  std::ptrdiff_t frames = 0;
  for (const std::string& part : parts) {
    const Outcome replay =
        RunTrack({"--sensor", "replay:" + Path(part), "--csv", Path("replayed.csv")}, scratch());
    ASSERT_EQ(replay.exit_status, 0) << replay.err;
    // The same number, the same frames.
    EXPECT_EQ(Rows({"replayed.csv"}), Rows({"run-" + part.substr(4) + ".csv"}));
    frames += Rows({"replayed.csv"});
  }
  EXPECT_EQ(frames, 30);
}

TEST_F(RotationTest, OldOnes_AreRemovedBeyondTheCountThoseOfEarlierRunsToo) {
  WriteFile(Path("run-000007.csv"), "of an earlier run\n");
  WriteFile(Path("run-000007.csv.bak"), "no output\n");
  const Outcome outcome = RunTrack({"--sensor", kSensor, "--csv", Path("run-{n}.csv"),
                                    "--rotate-age", "0.3", "--rotate-keep", "3"},
                                   scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  const std::set<std::string> left = Names("run-", ".csv");
  EXPECT_EQ(left.size(), 3U);
  EXPECT_FALSE(left.contains("run-000007.csv"));
  EXPECT_EQ(ReadFile(Path("run-000007.csv.bak")), "no output\n");
}

TEST_F(RotationTest, LiveRun_LosesNoRowAtTheRotation) {
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kEndlessSensor, "--rate", "live", "--csv", Path("run-{n}.csv"),
                      "--rotate-age", "0.2"},
                     scratch());
  ASSERT_TRUE(Eventually([this] { return Names("run-", ".csv").size() >= 5; }));
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  const std::string rows = Joined(Names("run-", ".csv"));
  std::istringstream lines(rows);
  std::string line;
  std::getline(lines, line);  // names
  int frame = 0;
  for (; std::getline(lines, line); ++frame)
    ASSERT_EQ(line.substr(0, line.find(',')), std::to_string(frame));
  EXPECT_NE(outcome.err.find(std::to_string(frame) + " frames"), std::string::npos) << outcome.err;
}

TEST_F(RotationTest, FileThatCannotGrow_EndsAndTheNextOneTakesWhatFollows) {
  // As on a disk that is full and has room again: no file may be larger than 15 KB.
  const ResourceLimit limit(RLIMIT_FSIZE, 15'000);
  const Outcome outcome = RunTrack(
      {"--sensor", kSensor, "--csv", Path("run-{n}.csv"), "--rotate-size", "1"}, scratch());
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find("run-000001.csv: cannot be written"), std::string::npos);
  EXPECT_GT(Names("run-", ".csv").size(), 2U);
  // The row that found no room is lost in each.
  const auto files = static_cast<std::ptrdiff_t>(Names("run-", ".csv").size());
  EXPECT_GE(Rows(Names("run-", ".csv")), 60 - files);
}

TEST_F(RotationTest, WhatCannotBeRotated_IsRefused) {
  const auto refusal = [this](const Arguments& more) {
    Arguments arguments = {"--sensor", "sim:box?frames=3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = RunTrack(arguments, scratch());
    EXPECT_EQ(outcome.exit_status, 2) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(refusal({"--rotate-age", "1"}).find("need --csv or --record"), std::string::npos);
  EXPECT_NE(refusal({"--rotate-age", "1", "--csv", Path("run.csv")}).find("run-{n}"),
            std::string::npos);
  EXPECT_NE(refusal({"--rotate-keep", "1", "--csv", Path("{n}.csv")}).find("--rotate-size"),
            std::string::npos);
  for (const char* age : {"0", "-1", "nan", "inf", "x"})
    (void)refusal({"--rotate-age", age, "--csv", Path("{n}.csv")});
}

}  // namespace
}  // namespace disflow::test
