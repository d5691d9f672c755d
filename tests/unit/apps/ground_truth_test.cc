// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "errors.h"
#include "scratch_dir.h"

namespace disflow::apps {
namespace {

using testing::IsSubstring;

class GroundTruthTest : public testing::Test {
 protected:
  std::string Refusal() {
    return MessageOf<InputError>([&] { (void)LoadGroundTruth(dir_.path()); });
  }

  ScratchDir dir_;
};

TEST_F(GroundTruthTest, AxisAngle_BecomesARotation) {
  dir_.Write("gt/poses.txt", "1 2 3 0 0 1 1.5707963267948966\n");
  const GroundTruth truth = LoadGroundTruth(dir_.path());
  ASSERT_EQ(truth.T_ct.size(), 1U);
  EXPECT_EQ(truth.T_ct[0].translation(), Vec3d(1, 2, 3));
  EXPECT_TRUE((truth.T_ct[0].rotation() * Vec3d(1, 0, 0)).isApprox(Vec3d(0, 1, 0), 1e-12));
}

TEST_F(GroundTruthTest, NoRotation_NeedsNoAxis) {
  dir_.Write("gt/poses.txt", "0 0 1 0 0 0 0\n");
  EXPECT_TRUE(LoadGroundTruth(dir_.path()).T_ct[0].rotation().isIdentity());
}

TEST_F(GroundTruthTest, StampsAndVelocities_AreReadBesideThePoses) {
  dir_.Write("gt/poses.txt", "0 0 1 1 0 0 0.1\n0 0 1 1 0 0 0.2\n");
  dir_.Write("gt/velocities.txt", "1 2 3 4 5 6\n7 8 9 10 11 12\n");
  dir_.Write("data.txt", "5 0.25 and more\n6 0.75\n");
  const GroundTruth truth = LoadGroundTruth(dir_.path());
  ASSERT_EQ(truth.twists.size(), 2U);
  EXPECT_EQ(truth.twists[1].linear_mps, Vec3d(7, 8, 9));
  EXPECT_EQ(truth.twists[1].angular_rps, Vec3d(10, 11, 12));
  EXPECT_EQ(truth.file_indices, (std::vector<int>{5, 6}));
  EXPECT_EQ(truth.stamps_s, (std::vector<double>{0.25, 0.75}));
}

TEST_F(GroundTruthTest, PosesAlone_AreEnough) {
  dir_.Write("gt/poses.txt", "0 0 1 1 0 0 0.1\n0 0 1 1 0 0 0.2\n");
  const GroundTruth truth = LoadGroundTruth(dir_.path());
  EXPECT_TRUE(truth.twists.empty());
  EXPECT_EQ(truth.file_indices, (std::vector<int>{0, 1}));
}

TEST_F(GroundTruthTest, NoFolderNoPosesOrEmptyPoses_AreRefused) {
  EXPECT_PRED_FORMAT2(IsSubstring, "is no folder",
                      MessageOf<InputError>([&] { (void)LoadGroundTruth(dir_.path() / "none"); }));
  EXPECT_PRED_FORMAT2(IsSubstring, "poses.txt: cannot be opened", Refusal());
  dir_.Write("gt/poses.txt", "\n\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "holds no pose", Refusal());
}

TEST_F(GroundTruthTest, PipeInPlaceOfAFile_IsRefusedWithoutBeingOpened) {
  dir_.Write("gt/model.obj", "");
  ASSERT_EQ(::mkfifo((dir_.path() / "gt/poses.txt").c_str(), 0600), 0);
  EXPECT_PRED_FORMAT2(IsSubstring, "poses.txt: is a pipe", Refusal());
  ASSERT_EQ(::mkfifo((dir_.path() / "data.txt").c_str(), 0600), 0);
  EXPECT_PRED_FORMAT2(IsSubstring, "data.txt: is a pipe", Refusal());
}

TEST_F(GroundTruthTest, TruncatedLine_IsRefusedWithItsNumber) {
  dir_.Write("gt/poses.txt", "0 0 1 1 0 0 0.1\n0 0 1 1 0\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "poses.txt:2: holds 5 fields, 7 are needed", Refusal());
}

TEST_F(GroundTruthTest, NumberThatIsNone_IsRefused) {
  dir_.Write("gt/poses.txt", "0 0 nan 1 0 0 0.1\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "poses.txt:1: field 3 is 'nan'", Refusal());
}

TEST_F(GroundTruthTest, AxisOfWrongLength_IsRefused) {
  dir_.Write("gt/poses.txt", "0 0 1 2 0 0 0.1\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "rotation axis has length 2", Refusal());
}

TEST_F(GroundTruthTest, FilesOfDifferentLength_AreRefused) {
  dir_.Write("gt/poses.txt", "0 0 1 1 0 0 0.1\n0 0 1 1 0 0 0.2\n");
  dir_.Write("gt/velocities.txt", "1 2 3 4 5 6\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "velocities.txt: holds 1 frames, gt/poses.txt holds 2",
                      Refusal());
}

/// A sequence whose program was killed: truth of a frame is written before its line in data.txt.
class CutTruth : public GroundTruthTest {
 protected:
  static constexpr const char* kPose = "0 0 1 1 0 0 0.1\n";
  static constexpr const char* kTwist = "1 2 3 4 5 6\n";

  void Write(const std::string& poses, const std::string& twists, const std::string& stamps) const {
    dir_.Write("gt/poses.txt", poses);
    dir_.Write("gt/velocities.txt", twists);
    dir_.Write("data.txt", stamps);
  }
  /// @return What was left out.
  std::string NoteOf(std::size_t frames) const {
    const GroundTruth truth = LoadGroundTruth(dir_.path());
    EXPECT_EQ(truth.T_ct.size(), frames);
    EXPECT_EQ(truth.twists.size(), frames);
    EXPECT_EQ(truth.stamps_s.size(), frames);
    EXPECT_EQ(truth.file_indices.size(), frames);
    return truth.note;
  }
  static std::string Twice(const std::string& text) { return text + text; }
};

TEST_F(CutTruth, WholeSequence_IsTakenWithoutAWord) {
  Write(Twice(kPose), Twice(kTwist), "0 0.000000000\n1 0.033333333\n");
  EXPECT_EQ(NoteOf(2), "");
}

TEST_F(CutTruth, FrameWithoutALineInDataTxt_IsLeftOutWithAWord) {
  Write(Twice(kPose), kTwist, "0 0.000000000\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "poses.txt", NoteOf(1));
  Write(Twice(kPose), Twice(kTwist), "0 0.000000000\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "velocities.txt", NoteOf(1));
}

TEST_F(CutTruth, LineThatIsCut_IsNotParsed) {
  Write(std::string(kPose) + "0 0 1 1 ", std::string(kTwist) + "nonsens", "0 0.000000000\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "cut short", NoteOf(1));
}

TEST_F(CutTruth, StampThatIsCut_LeavesItsFrameOut) {
  for (const char* cut : {"1", "1 ", "1 0.0333"}) {
    Write(Twice(kPose), Twice(kTwist), std::string("0 0.000000000\n") + cut);
    EXPECT_PRED_FORMAT2(IsSubstring, "data.txt", NoteOf(1)) << cut;
  }
}

TEST_F(CutTruth, MissingLineFeedAlone_CostsNothing) {
  Write(Twice(kPose), Twice(kTwist), "0 0.000000000\n1 0.033333333");
  EXPECT_EQ(NoteOf(2), "");
}

TEST_F(CutTruth, FilesThatDifferByMore_AreRefusedWithWhatToDo) {
  Write(Twice(Twice(kPose)), Twice(Twice(kTwist)), "0 0.000000000\n1 0.033333333\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "poses.txt: holds 4 frames, data.txt holds 2", Refusal());
  EXPECT_PRED_FORMAT2(IsSubstring, "keep the first 2 lines of each", Refusal());
  Write(kPose, kTwist, "0 0.000000000\n1 0.033333333\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "poses.txt: holds 1 frames, data.txt holds 2", Refusal());
}

TEST_F(CutTruth, NoFrameAtAll_IsRefused) {
  Write(kPose, kTwist, "");
  EXPECT_PRED_FORMAT2(IsSubstring, "data.txt: lists no frame", Refusal());
}

TEST_F(GroundTruthTest, StampFileOfOneColumn_IsRefused) {
  dir_.Write("gt/poses.txt", "0 0 1 1 0 0 0.1\n");
  dir_.Write("data.txt", "0.25\n");
  EXPECT_PRED_FORMAT2(IsSubstring, "data.txt:1: a frame index and a time stamp", Refusal());
}

}  // namespace
}  // namespace disflow::apps
