// SPDX-License-Identifier: BSD-3-Clause
// Masks of another process that hangs, lies, dies and comes back while the program runs.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdlib>
#include <optional>

#include "child_process.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "endless_run.h"
#include "estimate_csv.h"
#include "eventually.h"
#include "mask_writer.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

constexpr int kFrames = 30000;
constexpr std::uint32_t kWidth_px = 320;
constexpr std::uint32_t kHeight_px = 180;
/// Ten frames: more than a busy machine needs, and soon over.
constexpr const char* kMaskAge_s = "0.333";
constexpr int kMaskAge_frames = 10;

host::SimulationOptions Options() {
  host::SimulationOptions options;
  options.width_px = kWidth_px;
  options.height_px = kHeight_px;
  options.frames = kFrames;
  return options;
}

/// A program that tracks a box in masks of the other process, which is this test.
class MaskLoss : public ScratchFolderTest {
 protected:
  MaskLoss() {
    writer_.emplace(Path("masks"));
    track_.emplace(DISFLOW_TRACK,
                   Arguments{"--sensor", "sim:box?mask=none&width=320&height=180&frames=30000",
                             "--rate", "realtime", "--headless", "--csv", Path("run.csv"),
                             "--mask-stream", "file:" + Path("masks"), "--mask-age", kMaskAge_s},
                   scratch());
    Follow(20);
  }

  /// Frames that were tracked so far.
  [[nodiscard]] int Frames() const {
    const std::string text = ReadFile(Path("run.csv"));
    return static_cast<int>(std::count(text.begin(), text.end(), '\n')) - 1;
  }
  /// Whatever the other process does, so many frames more are tracked.
  void AwaitFrames(int more) {
    const int wanted = Frames() + more;
    ASSERT_TRUE(Eventually([&] { return Frames() >= wanted; })) << track_->said();
  }
  /// Masks as they should be, until so many frames more were tracked.
  void Follow(int more) {
    const int wanted = std::max(Frames(), 0) + more;
    ASSERT_TRUE(Eventually([&] {
      const int frame = std::max(Frames(), 0);
      simulation_.Render(frame, scene_);
      writer_->Write(scene_.stamp_ns, simulation_.gt_mask());
      return frame >= wanted;
    })) << track_->said();
  }
  /// The mask that was written last, again and again under stamps of now.
  void RepeatLast(int more) {
    const int wanted = Frames() + more;
    ASSERT_TRUE(Eventually([&] {
      const int frame = Frames();
      writer_->Write(simulation_.TruthAt(frame).stamp_ns, simulation_.gt_mask());
      return frame >= wanted;
    })) << track_->said();
  }
  /// What the report says of the masks.
  [[nodiscard]] static int Count(const Outcome& outcome, const std::string& what) {
    const std::size_t end = outcome.err.find(" " + what, outcome.err.find("masks from"));
    if (end == std::string::npos) return -1;
    return std::atoi(outcome.err.c_str() + outcome.err.rfind(' ', end - 1));
  }
  /// Expects that the object is the one of the first frame, and where it should be.
  Outcome StopAndExpectTrackedToTheEnd() {
    track_->Signal(SIGTERM);
    Outcome outcome = track_->Wait();
    EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
    const auto rows = apps::LoadEstimates(Path("run.csv"), kFrames).rows;
    const auto tie = [this](const apps::EstimateRow& row) {
      return row.T_co.Inverse() * apps::EstimatedPose(simulation_.TruthAt(row.frame).object.pose);
    };
    for (std::size_t i = rows.size() - 3; i < rows.size(); ++i) {
      EXPECT_EQ(rows[i].state, "tracking") << "row " << i;
      const Mat<double, 6> off = (tie(rows.front()).Inverse() * tie(rows[i])).Log();
      EXPECT_LT(off.head<3>().norm(), 0.02) << "row " << i;
      EXPECT_LT(off.tail<3>().norm(), 0.15) << "row " << i;
    }
    return outcome;
  }

  host::Simulation simulation_{Options(), host::MakeObjectMesh(host::ObjectKind::kBox)};
  DepthFrame scene_;
  std::optional<posix::MaskWriter> writer_;
  std::optional<ChildProcess> track_;
};

TEST_F(MaskLoss, StreamThatStandsStill_IsLeftAsideUntilItGoesOn) {
  AwaitFrames(3 * kMaskAge_frames);
  Follow(20);
  const Outcome outcome = StopAndExpectTrackedToTheEnd();
  EXPECT_GT(Count(outcome, "late"), kMaskAge_frames);
}

TEST_F(MaskLoss, StampsThatGoOnUnderAMaskThatDoesNot_CostNoObject) {
  RepeatLast(30);
  Follow(30);
  const Outcome outcome = StopAndExpectTrackedToTheEnd();
  EXPECT_NE(outcome.err.find(" 0 restarts"), std::string::npos) << outcome.err;
}

TEST_F(MaskLoss, StreamThatVanishes_IsFoundAgainWhenItComesBack) {
  for (int i = 0; i < 3; ++i) {
    writer_->Remove();
    AwaitFrames(10);
    writer_->Create();
    Follow(10);
  }
  const Outcome outcome = StopAndExpectTrackedToTheEnd();
  EXPECT_GE(Count(outcome, "missing"), 20);
  EXPECT_GE(Count(outcome, "used"), 20);
}

TEST_F(MaskLoss, WriterThatIsWrongInEveryWay_IsNamedOnceAndCostsNoFrame) {
  for (int i = 0; i < 3; ++i) {
    const StampNs stamp_ns = simulation_.TruthAt(Frames()).stamp_ns;
    writer_->Begin(stamp_ns, kWidth_px, kHeight_px);
    AwaitFrames(5);
    writer_->Truncate(100);
    AwaitFrames(5);
    writer_->Create();
    writer_->Write(stamp_ns, kHeight_px, kWidth_px, 255);
    AwaitFrames(5);
    writer_->PutByte(0, 0);
    AwaitFrames(5);
    writer_->Create();
    Follow(10);
  }
  const Outcome outcome = StopAndExpectTrackedToTheEnd();
  EXPECT_GE(Count(outcome, "of another size"), 5);
  EXPECT_GE(Count(outcome, "corrupt"), 5);
  for (const char* words : {"masks are not as large", "is no mask stream"}) {
    const std::size_t first = outcome.err.find(words);
    ASSERT_NE(first, std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find(words, first + 1), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace disflow::test
