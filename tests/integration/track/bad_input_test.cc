// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "child_process.h"
#include "estimate_csv.h"
#include "scratch_folder.h"
#include "sequence_files.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 10;
constexpr int kDamagedFrame = 6;

class BadInputTest : public ScratchFolderTest {
 protected:
  void SetUp() override {
    const Outcome recorded = RunTrack(
        {"--sensor", "sim:bottle?frames=" + std::to_string(kFrames), "--record", Path("sequence")},
        scratch());
    ASSERT_EQ(recorded.exit_status, 0) << recorded.err;
  }

  [[nodiscard]] SequenceFiles Files() const { return SequenceFiles(Path("sequence")); }
  [[nodiscard]] Outcome Track() const {
    return RunTrack({"--sensor", "replay:" + Path("sequence"), "--csv", Path("run.csv")},
                    scratch());
  }
  [[nodiscard]] std::vector<apps::EstimateRow> Rows() const {
    return apps::LoadEstimates(Path("run.csv"), kFrames).rows;
  }
  [[nodiscard]] std::vector<std::string> Statuses() const {
    std::vector<std::string> statuses;
    for (const auto& row : Rows()) statuses.push_back(row.status);
    return statuses;
  }
};

/// Damage to one frame in the middle, and the status that its row must have.
struct Damage {
  const char* name;
  void (*inflict)(const SequenceFiles& files);
  const char* status;
  int exit_status;
};

void PrintTo(const Damage& damage, std::ostream* stream) { *stream << damage.name; }

void FillDepth(const SequenceFiles& files, float value) {
  DepthFile depth = ReadDepth(files.depth(kDamagedFrame));
  depth.depth_m.assign(depth.depth_m.size(), value);
  WriteDepth(files.depth(kDamagedFrame), depth);
}

class DamagedFrame : public BadInputTest, public testing::WithParamInterface<Damage> {};

TEST_P(DamagedFrame, IsNamedAndTheOthersAreTracked) {
  GetParam().inflict(Files());
  const Outcome outcome = Track();
  EXPECT_EQ(outcome.exit_status, GetParam().exit_status) << outcome.err;
  const std::vector<std::string> statuses = Statuses();
  ASSERT_EQ(statuses.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(statuses[static_cast<std::size_t>(i)], i == kDamagedFrame ? GetParam().status : "ok")
        << "frame " << i << ": " << outcome.err;
  }
  const bool is_readable = GetParam().exit_status == 0;
  EXPECT_EQ(Rows()[kDamagedFrame].has_motion, is_readable)
      << "that of the frame before is no answer";
  if (!is_readable) {
    EXPECT_NE(outcome.err.find(std::to_string(kDamagedFrame)), std::string::npos) << outcome.err;
  }
}

INSTANTIATE_TEST_SUITE_P(
    BadInput, DamagedFrame,
    testing::Values(
        Damage{"DepthOfZeroSize",
               [](const SequenceFiles& files) { WriteDepth(files.depth(kDamagedFrame), {}); },
               "corrupt", 3},
        Damage{"DepthOfOtherSize",
               [](const SequenceFiles& files) {
                 WriteDepth(files.depth(kDamagedFrame), {4, 3, std::vector<float>(12, 1.0F)});
               },
               "corrupt", 3},
        Damage{"DepthOfAbsurdSize",
               [](const SequenceFiles& files) {
                 constexpr std::uint64_t kHuge = std::uint64_t{1} << 40U;
                 WriteDepth(files.depth(kDamagedFrame), {kHuge, kHuge, {}});
               },
               "corrupt", 3},
        Damage{"DepthTruncated",
               [](const SequenceFiles& files) { Truncate(files.depth(kDamagedFrame)); },
               "truncated", 3},
        Damage{"DepthMissing",
               [](const SequenceFiles& files) { fs::remove(files.depth(kDamagedFrame)); },
               "corrupt", 3},
        Damage{"DepthEmptyFile",
               [](const SequenceFiles& files) { WriteFile(files.depth(kDamagedFrame), ""); },
               "truncated", 3},
        Damage{"MaskIsNoPng",
               [](const SequenceFiles& files) {
                 WriteFile(files.mask(kDamagedFrame), "this is not an image");
               },
               "corrupt", 3},
        Damage{"DepthAllZero", [](const SequenceFiles& files) { FillDepth(files, 0.0F); },
               "no_valid_depth", 0},
        Damage{"DepthAllNan",
               [](const SequenceFiles& files) {
                 FillDepth(files, std::numeric_limits<float>::quiet_NaN());
               },
               "no_valid_depth", 0},
        Damage{"DepthAllInfinite",
               [](const SequenceFiles& files) {
                 FillDepth(files, std::numeric_limits<float>::infinity());
               },
               "no_valid_depth", 0},
        Damage{"DepthAllNegative", [](const SequenceFiles& files) { FillDepth(files, -1.0F); },
               "no_valid_depth", 0},
        Damage{
            "MaskEmpty",
            [](const SequenceFiles& files) { WriteMask(files.mask(kDamagedFrame), 640, 360, 0); },
            "empty_mask", 0},
        Damage{
            "MaskOfOtherSize",
            [](const SequenceFiles& files) { WriteMask(files.mask(kDamagedFrame), 64, 36, 255); },
            "mask_size_mismatch", 0}),
    [](const testing::TestParamInfo<Damage>& test) { return test.param.name; });

TEST_F(BadInputTest, NanAndInfinitySprinkledOverTheDepth_AreNoData) {
  for (int frame = 0; frame < kFrames; ++frame) {
    DepthFile depth = ReadDepth(Files().depth(frame));
    for (std::size_t i = 0; i < depth.depth_m.size(); i += 7) {
      depth.depth_m[i] = i % 2 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                    : -std::numeric_limits<float>::infinity();
    }
    WriteDepth(Files().depth(frame), depth);
  }
  const Outcome outcome = Track();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(Statuses(), std::vector<std::string>(kFrames, "ok"));
}

TEST_F(BadInputTest, AllDepthInvalid_EndsWithoutAPoseAndSaysWhy) {
  for (int frame = 0; frame < kFrames; ++frame) {
    DepthFile depth = ReadDepth(Files().depth(frame));
    depth.depth_m.assign(depth.depth_m.size(), 0.0F);
    WriteDepth(Files().depth(frame), depth);
  }
  const Outcome outcome = Track();
  EXPECT_EQ(outcome.exit_status, 3);
  EXPECT_NE(outcome.err.find("no frame could be tracked"), std::string::npos) << outcome.err;
  EXPECT_EQ(Statuses(), std::vector<std::string>(kFrames, "no_valid_depth"));
}

TEST_F(BadInputTest, IntrinsicsOfZero_AreRefused) {
  WriteFile(Files().intrinsics(), R"({"width":640,"height":360,"fx":0,"fy":0,"cx":320,"cy":180})");
  const Outcome outcome = Track();
  EXPECT_EQ(outcome.exit_status, 3);
  EXPECT_FALSE(outcome.err.empty());
}

TEST_F(BadInputTest, IntrinsicsTruncated_NameTheFile) {
  Truncate(Files().intrinsics());
  const Outcome outcome = Track();
  EXPECT_EQ(outcome.exit_status, 3);
  EXPECT_NE(outcome.err.find("cam_K.json"), std::string::npos) << outcome.err;
}

TEST_F(BadInputTest, IntrinsicsMissing_NameTheFile) {
  fs::remove(Files().intrinsics());
  const Outcome outcome = Track();
  EXPECT_EQ(outcome.exit_status, 3);
  EXPECT_NE(outcome.err.find("cam_K.json"), std::string::npos) << outcome.err;
}

TEST_F(BadInputTest, StampsThatStandStillOrRunBackwards_AreRefusedFrameByFrame) {
  std::string stamps;
  for (int frame = 0; frame < kFrames; ++frame) {
    // Frame 4 repeats frame 3, frame 7 is older than frame 6.
    const double stamp_s = frame == 4 ? 0.3 : frame == 7 ? 0.05 : 0.1 * frame;
    stamps.append(std::to_string(frame)).append(" ").append(std::to_string(stamp_s)).append("\n");
  }
  WriteFile(Files().stamps(), stamps);
  const Outcome outcome = Track();
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  const std::vector<std::string> statuses = Statuses();
  ASSERT_EQ(statuses.size(), static_cast<std::size_t>(kFrames));
  for (int frame = 0; frame < kFrames; ++frame) {
    const bool refused = frame == 4 || frame == 7;
    EXPECT_EQ(statuses[static_cast<std::size_t>(frame)], refused ? "stamp_not_increasing" : "ok")
        << frame;
    EXPECT_EQ(Rows()[static_cast<std::size_t>(frame)].has_motion, !refused) << frame;
  }
}

TEST_F(BadInputTest, FolderWithoutSequence_SaysWhatIsNeeded) {
  fs::create_directories(Path("empty"));
  const Outcome outcome = RunTrack({"--sensor", "replay:" + Path("empty")}, scratch());
  EXPECT_EQ(outcome.exit_status, 3);
  EXPECT_NE(outcome.err.find("empty"), std::string::npos) << outcome.err;
}

TEST_F(BadInputTest, ImageLargerThanTheProfile_IsNamed) {
  const Outcome outcome =
      RunTrack({"--sensor", "replay:" + Path("sequence"), "--profile", "micro"}, scratch());
  EXPECT_EQ(outcome.exit_status, 3);
  EXPECT_NE(outcome.err.find("larger than the profile"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace disflow::test
