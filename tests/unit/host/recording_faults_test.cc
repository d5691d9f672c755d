// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <random>
#include <utility>

#include "disflow/host/simulated_shapes.h"
#include "faulty_disk.h"
#include "recorded_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;
using test::disk;
using test::DiskEnd;
using test::FaultyDisk;

/// Records frames onto a disk that comes to its end, and plays what is there then.
class FaultyRecording : public testing::Test {
 protected:
  /// What had been done when a frame was complete.
  struct Done {
    std::int64_t bytes = 0;
    std::int64_t calls = 0;
  };

  void TearDown() override { disk = {}; }

  /// Once with all the room there is, to know what is done when.
  void RecordWhole() {
    disk = {};
    complete_.clear();
    ASSERT_EQ(Record(), frame_count());
    writes_ = disk.writes;
  }

  /// Records as disflow_track does. @return How many frames were recorded without a fault.
  int Record() {
    fs::remove_all(path());
    SequenceWriter writer;
    const hal::Fault opened = writer.Open(path(), "object", false);
    if (!opened.ok()) {
      ExpectSaysFull(opened);
      return 0;
    }
    for (int i = 0; i < frame_count(); ++i) {
      const hal::Fault fault = AddTo(writer, frames_[static_cast<std::size_t>(i)]);
      EXPECT_EQ(writer.frame_count(), fault.ok() ? i + 1 : i);
      if (!fault.ok()) {
        ExpectSaysFull(fault);
        return i;
      }
      if (complete_.size() <= static_cast<std::size_t>(i))
        complete_.push_back({disk.written_bytes, disk.calls});
    }
    const hal::Fault finished = writer.Finish();
    if (!finished.ok()) ExpectSaysFull(finished);
    return frame_count();
  }

  [[nodiscard]] hal::Fault AddTo(SequenceWriter& writer, CopiedFrame& copy) const {
    DepthFrame frame = copy.frame;
    frame.depth.data = copy.depth.data();
    if (frame.mask.given()) frame.mask.data = copy.mask.data();
    hal::Fault fault = writer.AddFrame(frame);
    if (fault.ok() && frame.mask.given()) fault = writer.AddMask("gt", frame.mask);
    if (fault.ok() && with_infrared_) fault = writer.AddInfrared(InfraredOf(frame));
    if (fault.ok() && with_truth_) fault = writer.AddTruth({});
    return fault.ok() ? writer.CompleteFrame() : fault;
  }

  /// The first bytes of the depth image, which are as good as any.
  [[nodiscard]] static MaskView InfraredOf(const DepthFrame& frame) {
    return {reinterpret_cast<const std::uint8_t*>(frame.depth.data), frame.depth.width_px,
            frame.depth.height_px, frame.depth.width_px};
  }

  void ExpectSaysFull(const hal::Fault& fault) const {
    const std::string message = fault.message;
    EXPECT_NE(message.find(path().string()), std::string::npos) << message;
    EXPECT_NE(message.find("No space left"), std::string::npos) << message;
  }

  /// Records in another process, which is killed.
  void RecordAndBeKilled(const FaultyDisk& faulty) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      disk = faulty;
      (void)Record();
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "killed before it was done";
  }

  /// Frames that were complete when so much was done.
  [[nodiscard]] std::size_t CompleteBefore(const Done& done) const {
    return static_cast<std::size_t>(
        std::count_if(complete_.begin(), complete_.end(), [&done](const Done& complete) {
          return complete.bytes <= done.bytes && complete.calls <= done.calls;
        }));
  }
  [[nodiscard]] std::size_t CompleteBefore(std::int64_t bytes) const {
    return CompleteBefore({bytes, FaultyDisk::kEndless});
  }

  /// What a replay's note must say.
  enum class Note {
    kNothing,   ///< Nothing is left out.
    kCutShort,  ///< Unless what the last frame lacks is not needed.
    kAny,       ///< The fault may have come where it left nothing behind.
  };

  /// @param complete So many frames must be replayed, bit for bit, and no more than one beyond.
  void ExpectReplay(std::size_t complete, Note note) {
    ReplayOptions options;
    options.dir = path();
    ReplaySensor sensor(options);
    const hal::Fault opened = sensor.Open();
    if (complete == 0 && !opened.ok()) {
      EXPECT_NE(std::string(opened.message).find(path().string()), std::string::npos)
          << opened.message;
      return;
    }
    ASSERT_TRUE(opened.ok()) << opened.message;
    const std::vector<CopiedFrame> replayed = PlayAll(sensor);
    ASSERT_GE(replayed.size(), complete);
    ASSERT_LE(replayed.size(), std::min(complete + 1, frames_.size()));
    for (std::size_t i = 0; i < replayed.size(); ++i) {
      ASSERT_TRUE(replayed[i].fault.ok()) << replayed[i].fault.message;
      EXPECT_EQ(replayed[i].depth, frames_[i].depth);
      EXPECT_EQ(replayed[i].frame.stamp_ns, frames_[i].frame.stamp_ns);
      EXPECT_EQ(replayed[i].frame.has_T_wc, frames_[i].frame.has_T_wc);
      if (!frames_[i].frame.mask.given()) continue;
      EXPECT_EQ(replayed[i].mask, frames_[i].mask);
    }
    if (note == Note::kNothing) {
      EXPECT_EQ(sensor.note(), "");
    } else if (replayed.size() == complete && (note == Note::kCutShort || !sensor.note().empty())) {
      EXPECT_NE(sensor.note().find("cut short"), std::string::npos) << sensor.note();
    }
  }

  [[nodiscard]] fs::path path() const { return dir_.path() / "recording"; }
  [[nodiscard]] int frame_count() const { return static_cast<int>(frames_.size()); }

  std::vector<CopiedFrame> frames_;
  bool with_infrared_ = false;
  bool with_truth_ = false;
  std::vector<Done> complete_;  ///< For every frame.
  std::vector<std::size_t> writes_;

 private:
  apps::ScratchDir dir_;
};

/// Every place of one recording that is of a kind of its own.
class RecordingFaults : public FaultyRecording {
 protected:
  void SetUp() override {
    constexpr int kFrames = 4;
    constexpr int kFirstWithMask = 1;
    SimulationOptions options;
    options.width_px = 8;
    options.height_px = 6;
    options.frames = kFrames;
    options.camera = CameraKind::kMoving;
    Simulation simulation(options, MakeObjectMesh(ObjectKind::kBox));
    for (int i = 0; i < kFrames; ++i) {
      DepthFrame frame;
      simulation.Render(i, frame);
      if (i < kFirstWithMask) frame.mask = {};
      frames_.push_back(CopyOf(frame));
    }
    ASSERT_NO_FATAL_FAILURE(RecordWhole());
  }

  /// Of the lines of data.txt every byte, of all else, which nobody reads before its line is there,
  /// the begin and some places within.
  [[nodiscard]] std::vector<std::int64_t> PlacesWithinWrites() const {
    constexpr std::int64_t kLongestLine = 32;
    constexpr std::int64_t kPlaces = 4;
    std::vector<std::int64_t> places;
    std::int64_t begin = 0;
    for (const std::size_t size : writes_) {
      const auto bytes = static_cast<std::int64_t>(size);
      const std::int64_t step = bytes <= kLongestLine ? 1 : bytes / kPlaces;
      for (std::int64_t within = 0; within < bytes; within += step)
        places.push_back(begin + within);
      begin += bytes;
    }
    return places;
  }
};

FaultyDisk DiskWith(std::int64_t room_bytes, DiskEnd end) {
  FaultyDisk faulty;
  faulty.room_bytes = room_bytes;
  faulty.end = end;
  return faulty;
}

TEST_F(RecordingFaults, DiskFullWithinAnyWrite_ReplaysAllFramesBefore) {
  for (const std::int64_t bytes : PlacesWithinWrites()) {
    SCOPED_TRACE("full after " + std::to_string(bytes) + " bytes");
    disk = DiskWith(bytes, DiskEnd::kFull);
    const int recorded = Record();
    disk = {};
    ASSERT_EQ(static_cast<std::size_t>(recorded), CompleteBefore(bytes));
    ExpectReplay(static_cast<std::size_t>(recorded), Note::kCutShort);
    if (HasFailure()) return;
  }
}

TEST_F(RecordingFaults, KilledWithinAnyWrite_ReplaysAllFramesBefore) {
  for (const std::int64_t bytes : PlacesWithinWrites()) {
    SCOPED_TRACE("killed after " + std::to_string(bytes) + " bytes");
    ASSERT_NO_FATAL_FAILURE(RecordAndBeKilled(DiskWith(bytes, DiskEnd::kKilled)));
    ExpectReplay(CompleteBefore(bytes), Note::kCutShort);
    if (HasFailure()) return;
  }
}

TEST_F(RecordingFaults, KilledBetweenTwoWrites_ReplaysAllFramesBefore) {
  std::int64_t bytes = 0;
  for (const std::size_t size : writes_) {
    bytes += static_cast<std::int64_t>(size);
    SCOPED_TRACE("killed after " + std::to_string(bytes) + " bytes");
    ASSERT_NO_FATAL_FAILURE(RecordAndBeKilled(DiskWith(bytes, DiskEnd::kKilledBefore)));
    const bool whole =
        std::any_of(complete_.begin(), complete_.end(),
                    [bytes](const Done& complete) { return complete.bytes == bytes; });
    ExpectReplay(CompleteBefore(bytes), whole ? Note::kNothing : Note::kCutShort);
    if (HasFailure()) return;
  }
}

TEST_F(RecordingFaults, AfterAFailure_NothingMoreIsRecordedHoweverMuchRoomThereIs) {
  CopiedFrame& copy = frames_[0];
  copy.frame.depth.data = copy.depth.data();
  SequenceWriter writer;
  fs::remove_all(path());
  ASSERT_TRUE(writer.Open(path(), "object", false).ok());
  ASSERT_TRUE(writer.AddFrame(copy.frame).ok());
  ASSERT_TRUE(writer.CompleteFrame().ok());
  disk.room_bytes = 100;
  const hal::Fault fault = writer.AddFrame(copy.frame);
  EXPECT_EQ(fault.status, Status::kIoError);
  disk = {};
  EXPECT_STREQ(writer.AddFrame(copy.frame).message, fault.message);
  EXPECT_STREQ(writer.Finish().message, fault.message);
  EXPECT_EQ(writer.frame_count(), 1);
  ExpectReplay(1, Note::kCutShort);
}

/// Recordings of any size with faults anywhere, the same ones every time.
class RandomRecordingFaults : public FaultyRecording {
 protected:
  /// 0 to bound - 1.
  std::int64_t Below(std::int64_t bound) {
    return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(bound));
  }
  bool Half() { return Below(2) == 0; }

  /// Noise: none can be taken for another frame's.
  void MakeFrames() {
    frames_.assign(static_cast<std::size_t>(1 + Below(6)), {});
    with_infrared_ = Half();
    with_truth_ = Half();
    const auto width = static_cast<int>(1 + Below(40));
    const auto height = static_cast<int>(1 + Below(30));
    const std::int64_t first_with_mask = Below(2 * frame_count());
    const std::int64_t first_with_pose = Below(2 * frame_count());
    std::int64_t stamp_ns = Below(std::int64_t{1} << Below(61));
    for (int i = 0; i < frame_count(); ++i) {
      CopiedFrame& copy = frames_[static_cast<std::size_t>(i)];
      std::vector<float> depth_m(static_cast<std::size_t>(width * height));
      for (float& value : depth_m) value = 1e-4F * static_cast<float>(1 + Below(65'535));
      copy.depth.resize(depth_m.size() * sizeof(float));
      std::memcpy(copy.depth.data(), depth_m.data(), copy.depth.size());
      copy.frame.depth = {copy.depth.data(), width, height,
                          static_cast<std::ptrdiff_t>(sizeof(float)) * width,
                          DepthFormat::kFloat32};
      copy.frame.camera = {100.0F, 100.0F, 4.0F, 3.0F};
      stamp_ns += 1 + Below(100'000'000);
      copy.frame.stamp_ns = stamp_ns;
      copy.frame.has_T_wc = i >= first_with_pose;
      if (i < first_with_mask) continue;
      copy.mask.resize(depth_m.size());
      for (std::uint8_t& value : copy.mask) value = Half() ? 255 : 0;
      copy.frame.mask = {copy.mask.data(), width, height, width};
    }
  }

  /// A fault at any byte or call of the recording that was made last.
  FaultyDisk AnyFault(const FaultyDisk& whole) {
    constexpr std::array<DiskEnd, 3> kEnds{DiskEnd::kFull, DiskEnd::kFullForAll, DiskEnd::kKilled};
    FaultyDisk faulty;
    faulty.end = kEnds[static_cast<std::size_t>(Below(kEnds.size()))];
    faulty.can_cut = Half();
    if (Below(3) == 0) {
      faulty.room_calls = Below(whole.calls);
    } else {
      faulty.room_bytes = Below(whole.written_bytes);
    }
    return faulty;
  }

 private:
  std::mt19937_64 random_{20261127};
};

std::string Describe(const FaultyDisk& faulty) {
  const std::string what = faulty.end == DiskEnd::kKilled ? "killed after " : "full after ";
  return faulty.room_calls == FaultyDisk::kEndless
             ? what + std::to_string(faulty.room_bytes) + " bytes"
             : what + std::to_string(faulty.room_calls) + " calls";
}

TEST_F(RandomRecordingFaults, FullOrKilledAt1000AnyPlaces_ReplaysAllFramesBefore) {
  constexpr int kRecordings = 125;
  constexpr int kFaults = 8;
  for (int recording = 0; recording < kRecordings; ++recording) {
    MakeFrames();
    ASSERT_NO_FATAL_FAILURE(RecordWhole());
    const FaultyDisk whole = std::exchange(disk, {});
    ExpectReplay(frames_.size(), Note::kNothing);
    for (int i = 0; i < kFaults; ++i) {
      const FaultyDisk faulty = AnyFault(whole);
      SCOPED_TRACE("recording " + std::to_string(recording) + ", " + Describe(faulty));
      std::size_t complete = CompleteBefore({faulty.room_bytes, faulty.room_calls});
      if (faulty.end == DiskEnd::kKilled) {
        ASSERT_NO_FATAL_FAILURE(RecordAndBeKilled(faulty));
      } else {
        disk = faulty;
        complete = static_cast<std::size_t>(Record());
        disk = {};
      }
      ExpectReplay(complete, Note::kAny);
      if (HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace disflow::host
