// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "disflow/hal/fault.h"
#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// What is recorded under one name.
struct McapChannel {
  std::string topic;
  std::string type;    ///< As ROS names it, e.g. nav_msgs/msg/Odometry.
  const char* schema;  ///< Its definition, as `ros2 interface show` has it.
};

/// Writes messages of ROS 2 (CDR) into an MCAP file, chunk by chunk. A chunk is handed to the
/// kernel in one piece, so that whatever ends the program costs the one that is being written and
/// no other; the index follows when the file is closed. Memory is that of one chunk.
class McapWriter {
 public:
  McapWriter() = default;
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  /// Creates the file. @return kBusy if it is there already, kIoError ..., naming it.
  [[nodiscard]] hal::Fault Open(const std::filesystem::path& file,
                                const std::vector<McapChannel>& channels);

  /// Adds a message to the chunk that comes next.
  /// @param channel Its place among the channels.
  void Add(std::size_t channel, std::int64_t time_ns, std::span<const std::uint8_t> message);
  /// Writes the chunk, if it holds anything.
  /// @return What could not be done; the file then ends behind the chunk before, and nothing more
  /// is written.
  [[nodiscard]] hal::Fault WriteChunk();

  /// Writes the chunk and the index, and closes.
  /// @return Also what the file system says no sooner than when a file is closed, as NFS does of a
  /// full disk: then any of it may be missing.
  [[nodiscard]] hal::Fault Close();

  /// Of what is whole, without the index.
  [[nodiscard]] std::uint64_t size_bytes() const noexcept { return size_; }

 private:
  struct Entry {
    std::size_t channel = 0;
    std::uint64_t time_ns = 0;
    std::uint64_t offset = 0;  ///< In the chunk's records.
  };

  [[nodiscard]] hal::Fault Write(std::span<const std::uint8_t> bytes);
  [[nodiscard]] hal::Fault Read(std::uint64_t begin, std::span<std::uint8_t> bytes) const;
  [[nodiscard]] hal::Fault WriteSummary();
  [[nodiscard]] hal::Fault AddChunkIndex(std::uint64_t& at, std::vector<std::uint8_t>& summary);
  [[nodiscard]] hal::Fault FlushSummary(std::vector<std::uint8_t>& summary);
  void AppendChannels(std::vector<std::uint8_t>& bytes) const;
  void AppendStatistics(std::vector<std::uint8_t>& bytes) const;
  [[nodiscard]] hal::Fault FileFault() const;

  std::filesystem::path file_;
  FileDescriptor descriptor_;
  std::vector<McapChannel> channels_;
  std::vector<std::uint64_t> counts_;  ///< Messages of each channel.
  std::uint64_t messages_ = 0;
  std::uint64_t first_ns_ = 0;
  std::uint64_t last_ns_ = 0;
  std::uint32_t chunks_ = 0;
  std::uint64_t data_begin_ = 0;  ///< Where the first chunk begins.
  std::uint64_t size_ = 0;        ///< Of what is whole.
  std::uint32_t summary_checksum_ = 0;
  std::vector<std::uint8_t> chunk_;  ///< With room for its head.
  std::vector<Entry> entries_;
  hal::Fault failure_;
};

}  // namespace disflow::posix
