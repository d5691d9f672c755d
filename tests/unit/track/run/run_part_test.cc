// SPDX-License-Identifier: BSD-3-Clause
#include "run/run_part.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "program/exit_status.h"
#include "scratch_folder.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

/// Records frames of a simulated box, tracked as in a run.
class RunPartTest : public test::ScratchFolderTest {
 protected:
  static constexpr int kWidth_px = 160;
  static constexpr int kHeight_px = 120;

  RunPartTest() : results_(1) {
    options_.profile = ProfileName::kMicro;
    options_.objects.resize(1);
    sensor_.width_px = kWidth_px;
    sensor_.height_px = kHeight_px;
    Begin();
  }

  void Begin() {
    host::SimulationOptions options;
    options.width_px = kWidth_px;
    options.height_px = kHeight_px;
    options.frames = 60;
    simulation_.emplace(options, host::MakeObjectMesh(host::ObjectKind::kBox));
    objects_.clear();
    objects_.push_back(MakeTrackedObject(options_.profile, options_.objects[0]));
    next_ = 0;
  }

  [[nodiscard]] RecordingQueue::Room Room() const {
    return {.width_px = kWidth_px,
            .height_px = kHeight_px,
            .objects = 1,
            .model_samples = MaxModelSamples(options_.profile)};
  }

  RunPart NewPart(const std::string& name, RecordingQueue* queue) {
    options_.record = Path(name);
    return RunPart(options_, sensor_, queue);
  }

  /// Tracks and records the next frame. @throws Failure as Record() does.
  void Record(RunPart& part) {
    DepthFrame frame;
    simulation_->Render(next_, frame);
    results_[0].frame = next_++;
    objects_[0]->Track(frame, {}, results_[0]);
    results_[0].total_ns = 1'000'000;
    part.Record(&frame, results_, objects_);
  }

  /// @return Files and their contents.
  [[nodiscard]] std::map<std::string, std::string> Contents(const std::string& name) const {
    std::map<std::string, std::string> contents;
    if (fs::is_regular_file(Path(name))) contents[""] = test::ReadFile(Path(name));
    if (!fs::is_directory(Path(name))) return contents;
    for (const auto& entry : fs::recursive_directory_iterator(Path(name))) {
      if (entry.is_regular_file())
        contents[fs::relative(entry.path(), Path(name))] = test::ReadFile(entry.path());
    }
    return contents;
  }

  void ExpectSameThroughTheQueue(const std::string& direct, const std::string& queued) {
    constexpr int kFrames = 40;
    std::vector<std::string> written;
    {
      RunPart part = NewPart(direct, nullptr);
      for (int i = 0; i < kFrames; ++i) Record(part);
      EXPECT_EQ(part.Finish(written), "");
    }
    Begin();
    RecordingQueue queue(Room());
    {
      RunPart part = NewPart(queued, &queue);
      for (int i = 0; i < kFrames; ++i) {
        Record(part);
        if (i % 10 == 9) queue.AwaitWritten();
      }
      EXPECT_EQ(part.Finish(written), "");
    }
    ASSERT_EQ(queue.dropped(), 0U);
    EXPECT_EQ(written[0], Path(direct) + ": 40 frames");
    EXPECT_EQ(written[1], Path(queued) + ": 40 frames");
    const auto expected = Contents(direct);
    const auto actual = Contents(queued);
    ASSERT_FALSE(expected.empty());
    ASSERT_EQ(actual.size(), expected.size());
    for (const auto& [file, bytes] : expected) {
      ASSERT_TRUE(actual.contains(file)) << file;
      EXPECT_TRUE(actual.at(file) == bytes) << file << " differs";
    }
  }

  Options options_;
  hal::SensorInfo sensor_;
  std::optional<host::Simulation> simulation_;
  TrackedObjects objects_;
  std::vector<FrameResult> results_;
  int next_ = 0;
};

TEST_F(RunPartTest, FolderThroughTheQueue_IsTheSameToTheByteAsWithoutIt) {
  ExpectSameThroughTheQueue("direct", "queued");
}

#if defined(DISFLOW_HAS_DDS) && defined(DISFLOW_HAS_ROSBAG)
TEST_F(RunPartTest, MessagesThroughTheQueue_AreTheSameToTheByteAsWithoutIt) {
  ExpectSameThroughTheQueue("direct.mcap", "queued.mcap");
}
#endif

TEST_F(RunPartTest, RecordingThatFailsBehindTheQueue_IsSaidOnceWithOneOfTheNextFrames) {
  RecordingQueue queue(Room());
  RunPart part = NewPart("recorded", &queue);
  Record(part);
  Record(part);
  queue.AwaitWritten();
  fs::remove_all(Path("recorded/depth"));
  EXPECT_NO_THROW(Record(part));
  queue.AwaitWritten();
  EXPECT_FALSE(part.has_failed());
  try {
    Record(part);
    ADD_FAILURE() << "not said";
  } catch (const Failure& failure) {
    const std::string words = failure.what();
    EXPECT_EQ(failure.status(), kOutputFailed);
    EXPECT_NE(words.find("recorded/depth/2.float: cannot be written: "), std::string::npos)
        << words;
    EXPECT_NE(words.find("; nothing more is recorded after 2 frames"), std::string::npos) << words;
  }
  EXPECT_TRUE(part.has_failed());
  EXPECT_NO_THROW(Record(part));
  std::vector<std::string> written;
  EXPECT_EQ(part.Finish(written), "") << "it has been said";
}

TEST_F(RunPartTest, TrajectoryThatFailed_IsNotListedAsWritten) {
  (void)std::signal(SIGPIPE, SIG_IGN);
  options_.objects.resize(2);
  options_.objects[0].files.csv = Path("pipe");
  options_.objects[1].files.csv = Path("whole.csv");
  ASSERT_EQ(::mkfifo(Path("pipe").c_str(), 0600), 0);
  const int reader = ::open(Path("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  RunPart part(options_, sensor_, nullptr);
  ASSERT_EQ(::close(reader), 0);
  EXPECT_THROW(part.WriteRow(0, {}), Failure);
  EXPECT_NO_THROW(part.WriteRow(1, {}));
  std::vector<std::string> written;
  EXPECT_EQ(part.Finish(written), "");
  EXPECT_EQ(written, std::vector<std::string>{Path("whole.csv") + ": trajectory"});
}

TEST_F(RunPartTest, LastFrameThatFailsBehindTheQueue_IsSaidAtTheEnd) {
  RecordingQueue queue(Room());
  RunPart part = NewPart("recorded", &queue);
  Record(part);
  queue.AwaitWritten();
  fs::remove_all(Path("recorded/depth"));
  Record(part);
  std::vector<std::string> written;
  EXPECT_NE(part.Finish(written).find("; nothing more is recorded after 1 frames"),
            std::string::npos);
  EXPECT_TRUE(written.empty());
}

}  // namespace
}  // namespace disflow::apps
