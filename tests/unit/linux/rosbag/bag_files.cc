// SPDX-License-Identifier: BSD-3-Clause
#include "bag_files.h"

#include <bzlib.h>
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <map>

namespace disflow::posix {
namespace {

constexpr std::size_t kCdrHead = 4;
constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);

template <class T>
Bytes Little(T value) {
  Bytes bytes(sizeof(value), '\0');
  std::memcpy(bytes.data(), &value, sizeof(value));
  return bytes;
}

Bytes Text(std::string_view text) {
  return Little(static_cast<std::uint32_t>(text.size())).append(text);
}

Bytes Record(std::uint8_t opcode, std::string_view content) {
  return (static_cast<char>(opcode) + Little(std::uint64_t{content.size()})).append(content);
}

std::uint32_t Crc(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

Bytes Lz4(std::string_view bytes) {
  Bytes packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

Bytes Bzip2(std::string_view bytes) {
  Bytes packed(bytes.size() + bytes.size() / 100 + 601, '\0');  // as its manual says
  auto size = static_cast<unsigned>(packed.size());
  Bytes source(bytes);
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, source.data(),
                                     static_cast<unsigned>(source.size()), 9, 0, 0),
            BZ_OK);
  packed.resize(size);
  return packed;
}

/// Of a bag's chunk.
Bytes Packed(std::string_view bytes, const std::string& compression) {
  if (compression == "lz4") return Lz4(bytes);
  return compression == "bz2" ? Bzip2(bytes) : Bytes(bytes);
}

Bytes Chunk(std::string_view records, const McapStyle& style) {
  Bytes packed(records);
  if (style.compression == "lz4") packed = Lz4(records);
  if (style.compression == "zstd") packed = Zstd(records);
  return Record(0x06, Little(std::uint64_t{0}) + Little(std::uint64_t{1}) +
                          Little(std::uint64_t{records.size()}) +
                          Little(style.checksums ? Crc(records) : 0U) + Text(style.compression) +
                          Little(std::uint64_t{packed.size()}) + packed);
}

}  // namespace

CdrWriter::CdrWriter(Wire wire) : wire_(wire) {
  if (wire != Wire::kRos1)
    bytes_ = wire == Wire::kBig ? Bytes(kCdrHead, '\0') : Bytes("\0\1\0\0", kCdrHead);
}

void CdrWriter::Append(const void* value, std::size_t size) {
  while (wire_ != Wire::kRos1 && (bytes_.size() - kCdrHead) % size != 0) bytes_ += '\0';
  Bytes bytes(static_cast<const char*>(value), size);
  if (wire_ == Wire::kBig) std::reverse(bytes.begin(), bytes.end());
  bytes_ += bytes;
}

CdrWriter& CdrWriter::AddText(std::string_view text) {
  if (wire_ == Wire::kRos1) return AddBytes(text);
  Add(static_cast<std::uint32_t>(text.size() + 1));
  bytes_.append(text).append(1, '\0');
  return *this;
}

CdrWriter& CdrWriter::AddBytes(std::string_view bytes) {
  Add(static_cast<std::uint32_t>(bytes.size()));
  bytes_.append(bytes);
  return *this;
}

CdrWriter& CdrWriter::AddHeader(std::int64_t stamp_ns) {
  if (wire_ == Wire::kRos1) Add(std::uint32_t{7});  // a number of the sender's own
  Add(static_cast<std::int32_t>(stamp_ns / 1'000'000'000));
  Add(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
  return AddText("camera_optical_frame");
}

Bytes ImageMessage(const TestImage& image, Wire wire) {
  CdrWriter writer(wire);
  writer.AddHeader(image.stamp_ns).Add(image.height_px).Add(image.width_px).AddText(image.encoding);
  writer.Add(static_cast<std::uint8_t>(0));
  const std::size_t rows = std::max<std::size_t>(image.height_px, 1);
  writer.Add(static_cast<std::uint32_t>(image.data.size() / rows));
  return writer.AddBytes(image.data).bytes();
}

Bytes CameraInfoMessage(std::int64_t stamp_ns, double fx, std::uint32_t width_px,
                        std::uint32_t height_px, Wire wire) {
  CdrWriter writer(wire);
  writer.AddHeader(stamp_ns).Add(height_px).Add(width_px).AddText("plumb_bob");
  writer.Add(std::uint32_t{5});
  for (int i = 0; i < 5; ++i) writer.Add(0.0);
  for (const double k : {fx, 0.0, 4.0, 0.0, 11.0, 3.0, 0.0, 0.0, 1.0}) writer.Add(k);
  for (const double r : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) writer.Add(r);
  for (const double p : {fx, 0.0, 4.0, 0.0, 0.0, 11.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0}) writer.Add(p);
  for (int i = 0; i < 6; ++i) writer.Add(std::uint32_t{0});
  return writer.Add(std::uint8_t{0}).bytes();
}

Bytes McapFile(const std::vector<RecordedMessage>& messages, const McapStyle& style) {
  Bytes file = Bytes(kMagic) + Record(0x01, Text("ros2") + Text("test"));
  std::map<std::string, std::uint16_t> channels;
  Bytes records;
  std::size_t in_chunk = 0;
  const auto flush = [&] {
    if (records.empty()) return;
    file += style.chunked ? Chunk(records, style) : records;
    records.clear();
    in_chunk = 0;
  };
  std::uint64_t time_ns = 1;
  for (const RecordedMessage& message : messages) {
    const auto next = static_cast<std::uint16_t>(channels.size() + 1);
    const auto [channel, is_new] = channels.emplace(message.topic, next);
    if (is_new) {
      records += Record(0x03, Little(next) + Text(message.type) + Text("ros2msg") + Text("# text"));
      records += Record(0x04, Little(next) + Little(next) + Text(message.topic) +
                                  Text(style.encoding) + Little(std::uint32_t{0}));
    }
    records += Record(0x05, Little(channel->second) + Little(std::uint32_t{0}) + Little(time_ns) +
                                Little(time_ns) + message.data);
    ++time_ns;
    if (++in_chunk == style.per_chunk) flush();
  }
  flush();
  if (!style.closed) return file;
  file += Record(0x0F, Little(style.checksums ? Crc(file) : 0U));
  const Bytes footer = Little(std::uint64_t{0}) + Little(std::uint64_t{0}) + Little(0U);
  return file + Record(0x02, footer) + Bytes(kMagic);
}

Bytes Ros1Bag(const std::vector<RecordedMessage>& messages, const std::string& compression,
              bool closed) {
  const auto field = [](std::string_view name, std::string_view value) {
    return Text(Bytes(name).append("=").append(value));
  };
  const auto record = [](std::string_view header, std::string_view data) {
    return Text(header) + Text(data);
  };
  const auto op = [&field](char code) { return field("op", Bytes(1, code)); };
  const Bytes head = op(3) + field("index_pos", Little(std::uint64_t{closed ? 4117U : 0U})) +
                     field("conn_count", Little(std::uint32_t{3})) +
                     field("chunk_count", Little(std::uint32_t{1}));
  constexpr std::size_t kHeadBytes = 4096;
  Bytes file = "#ROSBAG V2.0\n" + record(head, Bytes(kHeadBytes - head.size(), ' '));
  std::map<std::string, std::uint32_t> connections;
  Bytes records;
  const auto flush = [&] {
    if (records.empty()) return;
    const Bytes size = Little(static_cast<std::uint32_t>(records.size()));
    file += record(op(5) + field("compression", compression) + field("size", size),
                   Packed(records, compression));
    records.clear();
  };
  for (const RecordedMessage& message : messages) {
    const auto next = static_cast<std::uint32_t>(connections.size());
    const auto [connection, is_new] = connections.emplace(message.topic, next);
    const Bytes id = field("conn", Little(connection->second));
    if (is_new) {
      records += record(op(7) + id + field("topic", message.topic),
                        field("topic", message.topic) + field("type", message.type) +
                            field("md5sum", "*") + field("message_definition", "# text\n"));
    }
    records += record(op(2) + id + field("time", Little(std::uint64_t{1})), message.data);
    constexpr std::size_t kChunkBytes = 2000;
    if (records.size() > kChunkBytes) flush();
  }
  flush();
  return file;
}

Bytes Zstd(std::string_view bytes) {
  Bytes packed(ZSTD_compressBound(bytes.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), 1));
  return packed;
}

void Execute(const std::filesystem::path& file, const std::string& statements) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  sqlite3_close(database);
}

void WriteDb3(const std::filesystem::path& file, const std::vector<RecordedMessage>& messages) {
  Execute(file,
          "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
          "serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);"
          "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,"
          "timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
          "CREATE INDEX timestamp_idx ON messages (timestamp ASC);");
  std::map<std::string, int> topics;
  std::string statements = "BEGIN;";
  int time = 0;
  for (const RecordedMessage& message : messages) {
    const auto [topic, is_new] = topics.emplace(message.topic, static_cast<int>(topics.size()) + 1);
    const std::string id = std::to_string(topic->second);
    if (is_new) {
      statements += "INSERT INTO topics VALUES(" + id + ",'" + message.topic + "','" +
                    message.type + "','cdr','');";
    }
    std::string hex;
    for (const char c : message.data) {
      constexpr std::string_view kDigits = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(c);
      hex += kDigits[byte >> 4U];
      hex += kDigits[byte & 15U];
    }
    statements += "INSERT INTO messages(topic_id,timestamp,data) VALUES(" + id + "," +
                  std::to_string(++time) + ",x'" + hex + "');";
  }
  Execute(file, statements + "COMMIT;");
}

}  // namespace disflow::posix
