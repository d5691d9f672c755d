// SPDX-License-Identifier: BSD-3-Clause
// A disk that blocks while a live sensor is tracked: a file of the recording is a pipe that nobody
// reads from yet.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>

#include "child_process.h"
#include "endless_run.h"
#include "estimate_csv.h"
#include "eventually.h"
#include "said_number.h"

namespace disflow::test {
namespace {

namespace fs = std::filesystem;

class BlockedDisk : public ScratchFolderTest {
 protected:
  /// Starts a run that records, and blocks its disk with one of the next frames.
  void Start() {
    track_.emplace(
        DISFLOW_TRACK,
        Arguments{"--sensor", "sim:bottle?width=320&height=180&frames=30000", "--rate", "live",
                  "--headless", "--record", Path("recorded"), "--csv", Path("run.csv")},
        scratch());
    AwaitLines(Path("recorded/data.txt"), 3);
    // Nothing moves while the pipe is laid.
    track_->Signal(SIGSTOP);
    const auto images =
        std::distance(fs::directory_iterator(Path("recorded/depth")), fs::directory_iterator());
    blocked_ = static_cast<int>(images) + 3;
    pipe_ = Path("recorded/depth/" + std::to_string(blocked_) + ".float");
    ASSERT_EQ(::mkfifo(pipe_.c_str(), 0666), 0);
    track_->Signal(SIGCONT);
  }
  /// Rows of a file but for the one with the names.
  [[nodiscard]] int Rows() const { return Lines("run.csv") - 1; }
  [[nodiscard]] int Recorded() const { return Lines("recorded/data.txt"); }
  [[nodiscard]] int Lines(const std::string& file) const {
    const std::string text = ReadFile(Path(file));
    return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  }
  /// Until more frames were tracked than can wait for the disk.
  void AwaitFramesThatAreLeftOut() {
    constexpr int kWaiting = 30;
    constexpr int kMore = 20;
    ASSERT_TRUE(Eventually([this] { return Rows() >= blocked_ + kWaiting + kMore; }))
        << "tracking stands still";
  }
  /// The disk takes what it had kept waiting.
  void Unblock() {
    const std::string image = ReadFile(pipe_);  // to its end
    fs::remove(pipe_);
    WriteFile(pipe_, image);
  }
  [[nodiscard]] std::vector<double> Stamps(const std::string& csv) const {
    std::vector<double> stamps_s;
    for (const auto& row : apps::LoadEstimates(Path(csv), 30000).rows)
      stamps_s.push_back(row.timestamp_s);
    return stamps_s;
  }
  [[nodiscard]] std::vector<double> ReplayedStamps() const {
    const Outcome replay =
        RunTrack({"--sensor", "replay:" + Path("recorded"), "--csv", Path("again.csv")}, scratch());
    EXPECT_EQ(replay.exit_status, 0) << replay.err;
    return Stamps("again.csv");
  }

  std::optional<ChildProcess> track_;
  int blocked_ = 0;  ///< The frame whose image does not get onto the disk.
  fs::path pipe_;
};

TEST_F(BlockedDisk, EveryFrameIsTrackedAndThoseThatTheRecordingLacksAreCounted) {
  Start();
  AwaitFramesThatAreLeftOut();
  EXPECT_EQ(Recorded(), blocked_);
  EXPECT_TRUE(Eventually([this] {
    return track_->said().find("the disk does not keep up") != std::string::npos;
  })) << track_->said();
  Unblock();
  ASSERT_TRUE(Eventually([this] { return Recorded() > blocked_ + 40; })) << "it does not go on";
  track_->Signal(SIGTERM);
  const Outcome outcome = track_->Wait();
  EXPECT_EQ(outcome.exit_status, 4) << "the recording is not complete; " << outcome.err;
  const int left_out =
      NumberBefore(outcome.err, "frames left out because the disk did not keep up");
  EXPECT_GE(left_out, 20) << outcome.err;
  EXPECT_EQ(Recorded() + left_out, Rows()) << outcome.err;
  const std::size_t said = outcome.err.find("the disk does not keep up");
  EXPECT_EQ(outcome.err.find("the disk does not keep up", said + 1), std::string::npos)
      << "more than once: " << outcome.err;

  const std::vector<double> replayed_s = ReplayedStamps();
  EXPECT_EQ(static_cast<int>(replayed_s.size()), Recorded());
  const std::vector<double> tracked_s = Stamps("run.csv");
  EXPECT_TRUE(
      std::includes(tracked_s.begin(), tracked_s.end(), replayed_s.begin(), replayed_s.end()))
      << "frames in order, under stamps of their own";
}

TEST_F(BlockedDisk, KilledMeanwhile_ReplaysWhatWasOnTheDisk) {
  Start();
  AwaitFramesThatAreLeftOut();
  track_->Signal(SIGKILL);
  EXPECT_EQ(track_->Wait().exit_status, -SIGKILL);
  fs::remove(pipe_);
  EXPECT_EQ(static_cast<int>(ReplayedStamps().size()), blocked_);
}

/// Of a recording that is made of a replay nothing is ever left out, however fast it plays.
TEST_F(BlockedDisk, SequenceThatIsNotLive_IsWaitedForAndRecordedToTheByte) {
  ASSERT_EQ(RunTrack({"--sensor", "sim:box?width=320&height=180&mask=sloppy&frames=100",
                      "--headless", "--record", Path("recorded")},
                     scratch())
                .exit_status,
            0);
  const Outcome copied =
      RunTrack({"--sensor", "replay:" + Path("recorded"), "--headless", "--record", Path("copy")},
               scratch());
  ASSERT_EQ(copied.exit_status, 0) << copied.err;
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(Path("recorded"))) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path copy = Path("copy") / fs::relative(entry.path(), Path("recorded"));
    EXPECT_TRUE(ReadFile(entry.path()) == ReadFile(copy)) << copy << " differs";
  }
  EXPECT_EQ(files, 100 + 100 + 2) << "images, masks, stamps and camera";
}

}  // namespace
}  // namespace disflow::test
