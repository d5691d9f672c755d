// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdio>
#include <iterator>
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
  double most_add_m;           ///< Mean ADD over all frames and runs.
  std::span<const char* const> options = {};
};

constexpr const char* kOnePixel[] = {"--seed", "505,340"};
constexpr const char* kAsARoom[] = {"--profile", "dense", "--config", DISFLOW_ROOM_SETTINGS};

/// How many samples each run fuses per frame at most. It makes the runs differ by as much as any
/// change of the last bits does: a tenth of their error and more, by which one run alone passes or
/// not.
constexpr const char* kFuseBudgets[] = {"297", "300", "303"};

constexpr std::size_t kFrames = 99;
constexpr Recording kRecordings[] = {
    {"DragonGivenMask", "realsense_dragon", "gt", 6, 93, 0.0025},
    {"DragonSloppyMask", "realsense_dragon", "sloppy", 6, 92, 0.0018},
    {"MovedDragonGivenMask", "realsense_dragon_moved", "gt", 0, 97, 0.0025},
    {"MovedDragonSloppyMask", "realsense_dragon_moved", "sloppy", 0, 97, 0.0025},
    {"DragonOnePixel", "realsense_dragon", "none", 6, 93, 0.0025, kOnePixel},
    {"MovedDragonOnePixel", "realsense_dragon_moved", "none", 0, 95, 0.0030, kOnePixel},
    // The figure stands still on its desk, so that the camera's motion among all of it is its own.
    {"DeskAsARoom", "realsense_dragon", "none", 6, 92, 0.0020, kAsARoom},
};

void PrintTo(const Recording& recording, std::ostream* stream) { *stream << recording.name; }

class RecordedObject : public ScratchFolderTest, public testing::WithParamInterface<Recording> {
 protected:
  /// Tracks the recording and judges how often that was measured.
  /// @return The mean ADD.
  [[nodiscard]] double MeanAddOf(const fs::path& folder, const std::string& fuse_budget) const {
    const Recording& recording = GetParam();
    const std::string csv = Path("run-" + fuse_budget + ".csv");
    std::vector<std::string> words{
        "--sensor",  "replay:" + folder.string() + "?mask=" + recording.mask,
        "--csv",     csv,
        "--set",     "field.fuse_budget=" + fuse_budget,
        "--headless"};
    words.insert(words.end(), recording.options.begin(), recording.options.end());
    const Outcome tracked = RunTrack(words, scratch());
    EXPECT_EQ(tracked.exit_status, 0) << tracked.err;
    if (tracked.exit_status != 0) return 0.0;
    const std::vector<apps::EstimateRow> rows = apps::LoadEstimates(csv, kFrames).rows;
    std::size_t measured = 0;
    std::size_t repeated = 0;
    for (const apps::EstimateRow& row : rows) {
      measured += row.status == "ok" ? 1U : 0U;
      repeated += row.status == "repeated_image" ? 1U : 0U;
    }
    EXPECT_EQ(repeated, recording.repeated);
    EXPECT_GE(measured, recording.least_measured);
    const double add_m =
        apps::Evaluate(
            {.sequence = folder, .csv = csv, .model = folder / "gt" / "model.obj", .mesh = {}})
            .poses.add_m.mean;
    std::printf("%s: %zu of %zu frames measured, mean ADD %.2f mm\n", recording.name, measured,
                rows.size(), 1e3 * add_m);
    return add_m;
  }
};

TEST_P(RecordedObject, IsMeasuredInSoManyFramesAndSoWell) {
  const fs::path folder = TestData(GetParam().folder);
  DISFLOW_SKIP_WITHOUT(folder);
  double sum_m = 0.0;
  for (const char* const fuse_budget : kFuseBudgets) sum_m += MeanAddOf(folder, fuse_budget);
  EXPECT_LE(sum_m / std::size(kFuseBudgets), GetParam().most_add_m);
}

INSTANTIATE_TEST_SUITE_P(RealSense, RecordedObject, testing::ValuesIn(kRecordings),
                         [](const testing::TestParamInfo<Recording>& test) {
                           return test.param.name;
                         });

}  // namespace
}  // namespace disflow::test
