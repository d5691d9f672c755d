// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "disflow/posix/rosbag/mcap_writer.h"
#include "disk_fault_test.h"
#include "mcap_reader.h"

namespace disflow::posix {
namespace {

namespace fs = std::filesystem;
using test::disk;
using test::FaultyDisk;

using Message = std::vector<std::uint8_t>;
/// What one frame adds, in order: a channel and a message each.
using Frame = std::vector<std::pair<std::size_t, Message>>;

/// Recordings of any size with faults anywhere, the same ones every time.
class RandomMcapFaults : public test::DiskFaultTest {
 protected:
  void MakeFrames() {
    channels_.clear();
    for (std::int64_t i = 1 + Below(3); i > 0; --i)
      channels_.push_back({"/topic" + std::to_string(i), "std_msgs/msg/String", "string data\n"});
    frames_.assign(static_cast<std::size_t>(1 + Below(8)), {});
    for (Frame& frame : frames_) {
      frame.resize(static_cast<std::size_t>(1 + Below(4)));
      for (auto& [channel, message] : frame) {
        channel = static_cast<std::size_t>(Below(static_cast<std::int64_t>(channels_.size())));
        message.resize(static_cast<std::size_t>(4 + Below(1 + Below(3000))));
        for (std::uint8_t& byte : message) byte = static_cast<std::uint8_t>(Below(256));
        // What CDR begins with.
        std::fill_n(message.begin(), 4, std::uint8_t{0});
      }
    }
  }

  /// Records as disflow_track does, a chunk per frame. @return Frames recorded without a fault.
  std::size_t Record() override {
    fs::remove(path());
    McapWriter writer;
    const hal::Fault opened = writer.Open(path(), channels_);
    if (!opened.ok()) {
      ExpectSaysFull(opened);
      return 0;
    }
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      for (const auto& [channel, message] : frames_[i])
        writer.Add(channel, static_cast<std::int64_t>(1000 + i), message);
      const hal::Fault fault = writer.WriteChunk();
      if (!fault.ok()) {
        ExpectSaysFull(fault);
        EXPECT_FALSE(writer.Close().ok());
        return i;
      }
      if (complete_bytes_.size() <= i) complete_bytes_.push_back(disk.written_bytes);
    }
    const hal::Fault closed = writer.Close();
    if (!closed.ok()) ExpectSaysFull(closed);
    return frames_.size();
  }

  /// Frames that were complete when the program was killed there.
  [[nodiscard]] std::size_t CompleteBefore(const FaultyDisk& faulty) const {
    if (faulty.room_calls == 0) return 0;  // the file was not made
    return static_cast<std::size_t>(
        std::count_if(complete_bytes_.begin(), complete_bytes_.end(),
                      [&faulty](std::int64_t bytes) { return bytes <= faulty.room_bytes; }));
  }

  /// @param complete All of so many frames must be read, byte for byte, and no more than one
  /// beyond.
  void ExpectRead(std::size_t complete, std::uintmax_t whole_bytes) {
    std::error_code error;
    const std::uintmax_t bytes = fs::file_size(path(), error);
    for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
      McapReader reader;
      const hal::Fault opened = reader.Open(path(), channels_[channel].topic);
      if (!opened.ok()) {
        ASSERT_EQ(complete, 0U) << opened.message;
        continue;
      }
      std::vector<Message> read;
      BagMessage message;
      hal::Fault fault = reader.Next(message);
      for (; fault.ok(); fault = reader.Next(message))
        read.emplace_back(message.data.begin(), message.data.end());
      EXPECT_EQ(fault.status, Status::kEndOfStream) << fault.message;
      EXPECT_EQ(reader.note().empty(), bytes == whole_bytes) << reader.note();
      const std::vector<Message> least = Sent(channel, complete);
      const std::vector<Message> most = Sent(channel, std::min(complete + 1, frames_.size()));
      ASSERT_GE(read.size(), least.size());
      ASSERT_LE(read.size(), most.size());
      EXPECT_TRUE(std::equal(read.begin(), read.end(), most.begin()));
    }
  }

  /// What the first frames have added to a channel.
  [[nodiscard]] std::vector<Message> Sent(std::size_t channel, std::size_t frames) const {
    std::vector<Message> sent;
    for (std::size_t i = 0; i < frames; ++i) {
      for (const auto& [to, message] : frames_[i])
        if (to == channel) sent.push_back(message);
    }
    return sent;
  }

  [[nodiscard]] fs::path path() const override { return dir_.path() / "run.mcap"; }

  std::vector<McapChannel> channels_;
  std::vector<Frame> frames_;
  std::vector<std::int64_t> complete_bytes_;  ///< Written when a frame was complete.
};

TEST_F(RandomMcapFaults, FileThatCannotBeClosed_IsSaidOnceAndForAll) {
  MakeFrames();
  McapWriter writer;
  ASSERT_TRUE(writer.Open(path(), channels_).ok());
  writer.Add(0, 1000, frames_.front().front().second);
  ASSERT_TRUE(writer.WriteChunk().ok());
  disk.can_close = false;
  const hal::Fault closed = writer.Close();
  EXPECT_EQ(closed.status, Status::kIoError);
  ExpectSaysFull(closed);
  ExpectSaysFull(writer.Close());
}

TEST_F(RandomMcapFaults, FullOrKilledAt1000AnyPlaces_ReadsAllFramesBefore) {
  constexpr std::int64_t kSeldom = 20;  // three calls make a file and close it
  std::uintmax_t whole_bytes = 0;
  const auto make = [&] {
    MakeFrames();
    complete_bytes_.clear();
    disk = {};
    ASSERT_EQ(Record(), frames_.size());
    whole_ = std::exchange(disk, {});
    whole_bytes = fs::file_size(path());
    ExpectRead(frames_.size(), whole_bytes);
  };
  TryAThousandFaults(
      make, kSeldom, [&](const FaultyDisk& faulty) { return CompleteBefore(faulty); },
      [&](std::size_t complete) { ExpectRead(complete, whole_bytes); });
}

}  // namespace
}  // namespace disflow::posix
