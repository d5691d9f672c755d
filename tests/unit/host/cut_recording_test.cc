// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "recorded_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

/// A recording that ends otherwise than its program meant it to.
class CutRecording : public RecordedSequence {
 protected:
  void CutStamps(std::uintmax_t bytes) const {
    fs::resize_file(path() / "data.txt", fs::file_size(path() / "data.txt") - bytes);
  }
  /// The first `count` frames must be played, and what was left out be said.
  void ExpectFirst(std::size_t count, const std::string& named) const {
    ReplaySensor sensor(Replay());
    const hal::Fault opened = sensor.Open();
    ASSERT_TRUE(opened.ok()) << opened.message;
    const std::vector<CopiedFrame> frames = PlayAll(sensor);
    ASSERT_EQ(frames.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_TRUE(frames[i].fault.ok()) << frames[i].fault.message;
      EXPECT_EQ(frames[i].depth, frames_[i].depth);
      EXPECT_EQ(frames[i].frame.stamp_ns, frames_[i].frame.stamp_ns);
    }
    EXPECT_EQ(sensor.note().empty(), named.empty()) << sensor.note();
    EXPECT_NE(sensor.note().find(named), std::string::npos) << sensor.note();
  }
  void ExpectRefused(Status status, const std::string& named) const {
    ReplaySensor sensor(Replay());
    const hal::Fault opened = sensor.Open();
    EXPECT_EQ(opened.status, status) << opened.message;
    EXPECT_NE(std::string(opened.message).find(named), std::string::npos) << opened.message;
  }
};

TEST_F(CutRecording, Whole_IsReplayedWithoutAWord) {
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(sensor.note(), "");
}

TEST_F(CutRecording, StampThatIsCut_IsNotTakenForAnEarlierTime) {
  CutStamps(2);  // the line feed and the last decimal
  ExpectFirst(kFrames - 1, "5.float has no line in data.txt");
}

TEST_F(CutRecording, LineFeedThatIsMissing_CostsNothing) {
  CutStamps(1);
  ExpectFirst(kFrames, "");
}

TEST_F(CutRecording, StampsOfOthersWithoutTheLastLineFeed_AreTakenAsTheyAre) {
  Overwrite(path() / "data.txt", "0 1.25\n1 2.25\n2 3.25\n3 4.25\n4 5.25\n5 6");
  ReplaySensor sensor(Replay());
  ASSERT_TRUE(sensor.Open().ok());
  EXPECT_EQ(PlayAll(sensor).size(), std::size_t{kFrames});
  EXPECT_EQ(sensor.note(), "");
}

TEST_F(CutRecording, LastDepthThatIsCut_IsLeftOut) {
  for (const std::uintmax_t bytes : {std::uintmax_t{1000}, std::uintmax_t{0}}) {
    fs::resize_file(depth(kFrames - 1), bytes);
    ExpectFirst(kFrames - 1, "5.float");
  }
}

TEST_F(CutRecording, SeveralImagesWithoutALine_AreRefusedWithARemedy) {
  Overwrite(path() / "data.txt", "");
  ExpectRefused(Status::kCorrupt, "0.float and 5 more");
  ExpectRefused(Status::kCorrupt, "fps=30");
  fs::remove(path() / "data.txt");
  ReplayOptions options = Replay();
  options.rate_hz = 30.0;
  ReplaySensor sensor(options);
  EXPECT_TRUE(sensor.Open().ok()) << "the remedy works";
}

TEST_F(CutRecording, ImageInTheMiddleWithoutALine_IsRefused) {
  Overwrite(path() / "data.txt", "0 1\n1 2\n3 4\n4 5\n5 6\n");
  ExpectRefused(Status::kCorrupt, "2.float");
}

TEST_F(CutRecording, NoFrameThatIsWhole_IsRefused) {
  for (int i = 1; i < kFrames; ++i) fs::remove(depth(i));
  Overwrite(path() / "data.txt", "0 1.5");
  ExpectRefused(Status::kTruncated, "before its first frame was complete");
}

/// The first pose brings a line for each frame before.
TEST_F(CutRecording, LinesBeforeTheFirstPoseThatAreCut_CostNoMoreThanItsFrame) {
  CutStamps(5);
  for (const char* lines : {"", "no", "none\nnone\nnon", "none\nnone\nnone\nnone\nnone\n0 0 0.3"}) {
    Overwrite(path() / "T_wc.txt", lines);
    ExpectFirst(kFrames - 1, "5.float has no line in data.txt");
  }
  Overwrite(path() / "T_wc.txt", "none\nnone\n0 0 0 0 0 1 0\n");
  ExpectRefused(Status::kCorrupt, "T_wc.txt");
}

TEST_F(CutRecording, PosesThatAreMissing_AreRefusedStill) {
  CutStamps(5);
  Overwrite(path() / "T_wc.txt", "0 0 0 0 0 1 0\n0 0 0 0 0 1 0\n");
  ExpectRefused(Status::kCorrupt, "T_wc.txt");
}

}  // namespace
}  // namespace disflow::host
