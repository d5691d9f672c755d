// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "disflow/host/simulated_shapes.h"
#include "disk_fault_test.h"
#include "recorded_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;
using test::disk;
using test::DiskEnd;
using test::FaultyDisk;

/// Records frames onto a disk that comes to its end, and plays what is there then.
class FaultyRecording : public test::DiskFaultTest {
 protected:
  /// What had been done when a frame was complete.
  struct Done {
    std::int64_t bytes = 0;
    std::int64_t calls = 0;
  };

  /// Once with all the room there is, to know what is done when.
  void RecordWhole() {
    disk = {};
    complete_.clear();
    ASSERT_EQ(Record(), frames_.size());
    writes_ = disk.writes;
  }

  /// As disflow_track does.
  std::size_t Record() override {
    fs::remove_all(path());
    SequenceWriter writer;
    const hal::Fault opened = writer.Open(path(), "object", false);
    if (!opened.ok()) {
      ExpectSaysFull(opened);
      return 0;
    }
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      const hal::Fault fault = AddTo(writer, frames_[i]);
      EXPECT_EQ(static_cast<std::size_t>(writer.frame_count()), fault.ok() ? i + 1 : i);
      if (!fault.ok()) {
        ExpectSaysFull(fault);
        return i;
      }
      if (complete_.size() <= i) complete_.push_back({disk.written_bytes, disk.calls});
    }
    const hal::Fault finished = writer.Finish();
    if (!finished.ok()) ExpectSaysFull(finished);
    return frames_.size();
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

  [[nodiscard]] fs::path path() const override { return dir_.path() / "recording"; }
  [[nodiscard]] int frame_count() const { return static_cast<int>(frames_.size()); }

  std::vector<CopiedFrame> frames_;
  bool with_infrared_ = false;
  bool with_truth_ = false;
  std::vector<Done> complete_;  ///< For every frame.
  std::vector<std::size_t> writes_;
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
    const std::size_t recorded = Record();
    disk = {};
    ASSERT_EQ(recorded, CompleteBefore(bytes));
    ExpectReplay(recorded, Note::kCutShort);
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
};

TEST_F(RandomRecordingFaults, FullOrKilledAt1000AnyPlaces_ReplaysAllFramesBefore) {
  constexpr std::int64_t kOften = 3;  // every frame makes files
  const auto make = [&] {
    MakeFrames();
    ASSERT_NO_FATAL_FAILURE(RecordWhole());
    whole_ = std::exchange(disk, {});
    ExpectReplay(frames_.size(), Note::kNothing);
  };
  TryAThousandFaults(
      make, kOften,
      [&](const FaultyDisk& faulty) {
        return CompleteBefore({faulty.room_bytes, faulty.room_calls});
      },
      [&](std::size_t complete) { ExpectReplay(complete, Note::kAny); });
}

}  // namespace
}  // namespace disflow::host
