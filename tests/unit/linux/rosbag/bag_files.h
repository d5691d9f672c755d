// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// @file
/// Recordings as ROS 2 writes them, byte by byte, so that tests can damage them.

namespace disflow::posix {

using Bytes = std::string;

enum class Wire : std::uint8_t {
  kLittle,  ///< CDR as almost everybody sends it.
  kBig,     ///< CDR of some embedded senders.
  kRos1,
};

/// A message as ROS puts it into bytes.
class CdrWriter {
 public:
  explicit CdrWriter(Wire wire = Wire::kLittle);
  /// Aligns and adds a number.
  template <class T>
  CdrWriter& Add(T value) {
    Append(&value, sizeof(value));
    return *this;
  }
  CdrWriter& AddText(std::string_view text);
  CdrWriter& AddBytes(std::string_view bytes);
  CdrWriter& AddHeader(std::int64_t stamp_ns);
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  void Append(const void* value, std::size_t size);

  Bytes bytes_;
  Wire wire_;
};

struct TestImage {
  std::int64_t stamp_ns = 0;
  std::string encoding = "16UC1";
  std::uint32_t width_px = 8;
  std::uint32_t height_px = 6;
  Bytes data;
};
[[nodiscard]] Bytes ImageMessage(const TestImage& image, Wire wire = Wire::kLittle);
[[nodiscard]] Bytes CameraInfoMessage(std::int64_t stamp_ns, double fx, std::uint32_t width_px = 8,
                                      std::uint32_t height_px = 6, Wire wire = Wire::kLittle);

struct RecordedMessage {
  std::string topic;
  std::string type;  ///< sensor_msgs/msg/Image
  Bytes data;
};

struct McapStyle {
  bool chunked = true;
  std::string compression = "";  ///< Of chunks: "", lz4, zstd.
  std::size_t per_chunk = 4;
  bool checksums = true;
  bool closed = true;  ///< With an end, as if the recorder was not killed.
  std::string encoding = "cdr";
};
[[nodiscard]] Bytes McapFile(const std::vector<RecordedMessage>& messages, const McapStyle& style);

/// A bag of ROS 1, format 2.0, without its index.
/// @param compression Of chunks: none, lz4, bz2.
/// @param closed As if the recorder was not killed.
[[nodiscard]] Bytes Ros1Bag(const std::vector<RecordedMessage>& messages,
                            const std::string& compression, bool closed = true);

/// Compresses by itself, as rosbag2's message mode does.
[[nodiscard]] Bytes Zstd(std::string_view bytes);

/// Runs statements on a database, which is made if it is not there.
void Execute(const std::filesystem::path& file, const std::string& statements);
/// A database as rosbag2 writes it.
void WriteDb3(const std::filesystem::path& file, const std::vector<RecordedMessage>& messages);

}  // namespace disflow::posix
