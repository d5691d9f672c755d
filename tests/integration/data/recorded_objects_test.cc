// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "child_process.h"
#include "estimate_csv.h"
#include "evaluation.h"
#include "scratch_folder.h"
#include "test_data.h"

/// @file
/// Real objects before a real camera, tracked by disflow_track and judged against their reference.

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

/// What a recording has to give today; tightened as the tracker gets better.
struct Recording {
  const char* name;
  const char* folder;
  const char* mask;
  std::size_t repeated;        ///< Images that are the one before once more: predicted.
  std::size_t least_measured;  ///< Of the other frames, those whose status is "ok".
  double most_add_m;           ///< Mean ADD over all frames.
  std::span<const char* const> options = {};
};

constexpr const char* kOnePixel[] = {"--seed", "505,340"};
constexpr const char* kAsARoom[] = {"--profile", "dense", "--config", DISFLOW_ROOM_SETTINGS};

constexpr std::size_t kFrames = 99;
constexpr Recording kRecordings[] = {
    {"DragonGivenMask", "realsense_dragon", "gt", 6, 93, 0.0025},
    {"DragonSloppyMask", "realsense_dragon", "sloppy", 6, 92, 0.0018},
    {"MovedDragonGivenMask", "realsense_dragon_moved", "gt", 0, 97, 0.0025},
    {"MovedDragonSloppyMask", "realsense_dragon_moved", "sloppy", 0, 85, 0.0040},
    {"DragonOnePixel", "realsense_dragon", "none", 6, 93, 0.0025, kOnePixel},
    {"MovedDragonOnePixel", "realsense_dragon_moved", "none", 0, 95, 0.0030, kOnePixel},
    // The figure stands still on its desk, so that the camera's motion among all of it is its own.
    {"DeskAsARoom", "realsense_dragon", "none", 6, 92, 0.0020, kAsARoom},
};

void PrintTo(const Recording& recording, std::ostream* stream) { *stream << recording.name; }

class RecordedObject : public ScratchFolderTest, public testing::WithParamInterface<Recording> {};

TEST_P(RecordedObject, IsMeasuredInSoManyFramesAndSoWell) {
  const Recording& recording = GetParam();
  const fs::path folder = TestData(recording.folder);
  DISFLOW_SKIP_WITHOUT(folder);
  std::vector<std::string> words{"--sensor",
                                 "replay:" + folder.string() + "?mask=" + recording.mask, "--csv",
                                 Path("run.csv"), "--headless"};
  words.insert(words.end(), recording.options.begin(), recording.options.end());
  const Outcome tracked = RunTrack(words, scratch());
  ASSERT_EQ(tracked.exit_status, 0) << tracked.err;
  const std::vector<apps::EstimateRow> rows = apps::LoadEstimates(Path("run.csv"), kFrames).rows;
  std::size_t measured = 0;
  std::size_t repeated = 0;
  for (const apps::EstimateRow& row : rows) {
    measured += row.status == "ok" ? 1U : 0U;
    repeated += row.status == "repeated_image" ? 1U : 0U;
  }
  const apps::Report report = apps::Evaluate({.sequence = folder,
                                              .csv = Path("run.csv"),
                                              .model = folder / "gt" / "model.obj",
                                              .mesh = {}});
  std::printf("%s: %zu of %zu frames measured, mean ADD %.2f mm\n", recording.name, measured,
              rows.size(), 1e3 * report.poses.add_m.mean);
  EXPECT_EQ(repeated, recording.repeated);
  EXPECT_GE(measured, recording.least_measured);
  EXPECT_LE(report.poses.add_m.mean, recording.most_add_m);
}

INSTANTIATE_TEST_SUITE_P(RealSense, RecordedObject, testing::ValuesIn(kRecordings),
                         [](const testing::TestParamInfo<Recording>& test) {
                           return test.param.name;
                         });

}  // namespace
}  // namespace disflow::test
