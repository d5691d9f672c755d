// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <limits>

#include "disflow/host/simulated_shapes.h"
#include "recorded_sequence.h"

// The linker leads every write() of the recorder here (--wrap): a disk that is full after so many
// bytes, or a program that is killed there.
namespace {

enum class AtTheEnd {
  kFull,          ///< What has room is written, then there is no more.
  kKilled,        ///< Killed with what has room written, in the middle of a write or at its begin.
  kKilledBefore,  ///< Killed as soon as so many bytes are written, before anything else is done.
};

struct Disk {
  std::int64_t room_bytes = std::numeric_limits<std::int64_t>::max();
  AtTheEnd end = AtTheEnd::kFull;
  std::int64_t written_bytes = 0;
  std::vector<std::size_t> writes;  ///< Their sizes.
};

Disk disk;

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier): the linker's names
extern "C" ssize_t __real_write(int fd, const void* bytes, std::size_t size);
extern "C" ssize_t __wrap_write(int fd, const void* bytes, std::size_t size);
extern "C" ssize_t __wrap_write(int fd, const void* bytes, std::size_t size) {
  const auto room = static_cast<std::size_t>(disk.room_bytes);
  const std::size_t fits = std::min(size, room);
  const ssize_t written = fits > 0 || size == 0 ? __real_write(fd, bytes, fits) : 0;
  if (written < 0) return written;
  disk.room_bytes -= written;
  disk.written_bytes += written;
  if (disk.end == AtTheEnd::kKilledBefore && disk.room_bytes == 0) (void)::raise(SIGKILL);
  if (disk.end == AtTheEnd::kKilled && fits < size) (void)::raise(SIGKILL);
  disk.writes.push_back(static_cast<std::size_t>(written));
  if (written > 0 || size == 0) return written;
  errno = ENOSPC;
  return -1;
}
// NOLINTEND(bugprone-reserved-identifier)

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 4;
constexpr int kFirstWithMask = 1;

class RecordingFaults : public testing::Test {
 protected:
  void SetUp() override {
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
    // Once with all the room there is, to know what is written when.
    disk = {};
    ASSERT_EQ(Record(), kFrames);
    writes_ = disk.writes;
  }
  void TearDown() override { disk = {}; }

  /// Records as disflow_track does. @return How many frames were recorded without a fault.
  int Record() {
    fs::remove_all(path());
    SequenceWriter writer;
    if (!writer.Open(path(), "object", false).ok()) return 0;
    for (int i = 0; i < kFrames; ++i) {
      CopiedFrame& copy = frames_[static_cast<std::size_t>(i)];
      DepthFrame frame = copy.frame;
      frame.depth.data = copy.depth.data();
      if (frame.mask.given()) frame.mask.data = copy.mask.data();
      hal::Fault fault = writer.AddFrame(frame);
      if (fault.ok() && frame.mask.given()) fault = writer.AddMask("gt", frame.mask);
      if (fault.ok()) fault = writer.CompleteFrame();
      EXPECT_EQ(writer.frame_count(), fault.ok() ? i + 1 : i);
      if (!fault.ok()) {
        EXPECT_NE(std::string(fault.message).find(path().string()), std::string::npos);
        EXPECT_NE(std::string(fault.message).find("No space left"), std::string::npos);
        return i;
      }
      if (complete_bytes_.size() <= static_cast<std::size_t>(i))
        complete_bytes_.push_back(disk.written_bytes);
    }
    EXPECT_TRUE(writer.Finish().ok());
    return kFrames;
  }

  /// Records in another process, which is killed.
  void RecordAndBeKilled(std::int64_t room_bytes, AtTheEnd end) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      disk = {.room_bytes = room_bytes, .end = end, .written_bytes = 0, .writes = {}};
      (void)Record();
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "killed before it was done";
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

  /// Frames whose last byte was written before the disk's end.
  [[nodiscard]] std::size_t CompleteBefore(std::int64_t bytes) const {
    return static_cast<std::size_t>(
        std::count_if(complete_bytes_.begin(), complete_bytes_.end(),
                      [bytes](std::int64_t complete) { return complete <= bytes; }));
  }

  /// @param complete So many frames must be replayed, bit for bit, and no more than one beyond.
  /// @param whole Nothing is left out.
  void ExpectReplay(std::size_t complete, bool whole) {
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
    ASSERT_LE(replayed.size(), complete + 1);
    for (std::size_t i = 0; i < replayed.size(); ++i) {
      ASSERT_TRUE(replayed[i].fault.ok()) << replayed[i].fault.message;
      EXPECT_EQ(replayed[i].depth, frames_[i].depth);
      EXPECT_EQ(replayed[i].frame.stamp_ns, frames_[i].frame.stamp_ns);
      EXPECT_TRUE(replayed[i].frame.has_T_wc);
      if (!frames_[i].frame.mask.given()) continue;
      EXPECT_EQ(replayed[i].mask, frames_[i].mask);
    }
    if (whole) {
      EXPECT_EQ(sensor.note(), "");
    } else if (replayed.size() == complete) {
      EXPECT_NE(sensor.note().find("cut short"), std::string::npos) << sensor.note();
    }
  }

  [[nodiscard]] fs::path path() const { return dir_.path() / "recording"; }

  std::vector<CopiedFrame> frames_;
  std::vector<std::int64_t> complete_bytes_;  ///< Written when a frame was complete.
  std::vector<std::size_t> writes_;

 private:
  apps::ScratchDir dir_;
};

TEST_F(RecordingFaults, DiskFullWithinAnyWrite_ReplaysAllFramesBefore) {
  for (const std::int64_t bytes : PlacesWithinWrites()) {
    SCOPED_TRACE("full after " + std::to_string(bytes) + " bytes");
    disk = {.room_bytes = bytes, .end = AtTheEnd::kFull, .written_bytes = 0, .writes = {}};
    const int recorded = Record();
    disk = {};
    ASSERT_EQ(static_cast<std::size_t>(recorded), CompleteBefore(bytes));
    ExpectReplay(static_cast<std::size_t>(recorded), false);
    if (HasFailure()) return;
  }
}

TEST_F(RecordingFaults, KilledWithinAnyWrite_ReplaysAllFramesBefore) {
  for (const std::int64_t bytes : PlacesWithinWrites()) {
    SCOPED_TRACE("killed after " + std::to_string(bytes) + " bytes");
    ASSERT_NO_FATAL_FAILURE(RecordAndBeKilled(bytes, AtTheEnd::kKilled));
    ExpectReplay(CompleteBefore(bytes), false);
    if (HasFailure()) return;
  }
}

TEST_F(RecordingFaults, KilledBetweenTwoWrites_ReplaysAllFramesBefore) {
  std::int64_t bytes = 0;
  for (const std::size_t size : writes_) {
    bytes += static_cast<std::int64_t>(size);
    SCOPED_TRACE("killed after " + std::to_string(bytes) + " bytes");
    ASSERT_NO_FATAL_FAILURE(RecordAndBeKilled(bytes, AtTheEnd::kKilledBefore));
    const bool whole =
        std::find(complete_bytes_.begin(), complete_bytes_.end(), bytes) != complete_bytes_.end();
    ExpectReplay(CompleteBefore(bytes), whole);
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
  ExpectReplay(1, false);
}

}  // namespace
}  // namespace disflow::host
