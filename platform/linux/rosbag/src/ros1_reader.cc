// SPDX-License-Identifier: BSD-3-Clause
#include "ros1_reader.h"

#include <algorithm>

namespace disflow::posix {
namespace {

using hal::Fault;

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
/// What a record is; the others are of the index.
enum Op : std::uint8_t { kMessage = 0x02, kBagHeader = 0x03, kChunk = 0x05, kConnection = 0x07 };

/// Definitions of messages stand in the data of connections, not in headers.
constexpr std::uint32_t kMostHeaderBytes = 65536;
constexpr std::size_t kLongestTypeName = 255;
constexpr std::size_t kMostConnections = 4096;

template <class T>
void Load(std::span<std::uint8_t> value, T& number) {
  ByteCursor cursor(value);
  number = cursor.Take<T>();
}

std::string_view AsText(std::span<std::uint8_t> value) {
  return {reinterpret_cast<const char*>(value.data()), value.size()};
}

}  // namespace

Fault Ros1Reader::Open(const std::filesystem::path& file, const std::string& topic) {
  topic_ = topic;
  at_ = kMagic.size();
  const Fault fault = file_.Open(file);
  if (fault.ok() && file_.size() < at_) return file_.Corrupt(0, "is too short for a bag");
  // Its first record says whether it was closed.
  BagMessage message;
  bool found = false;
  return fault.ok() && file_.size() > at_ ? TakeFromFile(message, found) : fault;
}

std::string Ros1Reader::note() const { return closed_ ? "" : file_.CutShort(); }

/// `name=value`, each with its length ahead.
bool Ros1Reader::ReadHeader(std::span<std::uint8_t> bytes, Header& header) {
  ByteCursor cursor(bytes);
  while (cursor.ok() && !cursor.rest().empty()) {
    const auto field = cursor.TakeBytes(cursor.Take<std::uint32_t>());
    const auto equals = std::find(field.begin(), field.end(), '=');
    if (equals == field.end()) return false;
    const std::string_view name =
        AsText(field.first(static_cast<std::size_t>(equals - field.begin())));
    const auto value = field.subspan(name.size() + 1);
    if (name == "op") Load(value, header.op);
    if (name == "conn") Load(value, header.connection);
    if (name == "size") Load(value, header.size);
    if (name == "index_pos") Load(value, header.index_position);
    if (name == "topic") header.topic = AsText(value);
    if (name == "type") header.type = AsText(value);
    if (name == "compression") header.compression = AsText(value);
  }
  return cursor.ok();
}

Fault Ros1Reader::Next(BagMessage& message) {
  for (bool found = false;;) {
    const Fault fault =
        chunk_rest_.empty() ? TakeFromFile(message, found) : TakeFromChunk(message, found);
    if (!fault.ok() || found) return fault;
  }
}

Fault Ros1Reader::TakeFromFile(BagMessage& message, bool& found) {
  const std::uint64_t begin = at_;
  // The next call is behind all if this one ends in the midst of a record.
  at_ = file_.size();
  std::array<std::uint8_t, sizeof(std::uint32_t)> length{};
  const auto read_length = [&](std::uint64_t at, std::uint64_t& bytes) {
    if (file_.size() - at < length.size()) return file_.IsOver();
    const Fault fault = file_.Read(at, length);
    bytes = ByteCursor(length).Take<std::uint32_t>();
    if (fault.ok() && bytes > file_.size() - at - length.size()) {
      // What a killed recorder leaves is said by note().
      return closed_ ? file_.Corrupt(begin, "a record is longer than the file") : file_.IsOver();
    }
    return fault;
  };
  std::uint64_t header_bytes = 0;
  Fault fault = read_length(begin, header_bytes);
  if (!fault.ok()) return fault;
  if (header_bytes > kMostHeaderBytes) return file_.Corrupt(begin, "a record's header is too long");
  header_.resize(static_cast<std::size_t>(header_bytes));
  fault = file_.Read(begin + length.size(), header_);
  if (!fault.ok()) return fault;
  Header header;
  if (!ReadHeader(header_, header)) return file_.Corrupt(begin, "a record's header is damaged");
  // Zeros would be records without end.
  if (header.op == 0) return file_.Corrupt(begin, "is no record; what follows cannot be read");
  if (header.op == kBagHeader) closed_ = header.index_position != 0;
  const std::uint64_t data_at = begin + length.size() + header_bytes;
  std::uint64_t data_bytes = 0;
  fault = read_length(data_at, data_bytes);
  if (!fault.ok()) return fault;
  at_ = data_at + length.size() + data_bytes;
  if (header.op != kChunk && header.op != kMessage && header.op != kConnection) return {};
  if (data_bytes > kMostMessageBytes) return file_.Corrupt(begin, "a record is too long");
  data_.resize(static_cast<std::size_t>(data_bytes));
  fault = file_.Read(data_at + length.size(), data_);
  if (!fault.ok()) return fault;
  chunk_begin_ = begin;
  return header.op == kChunk ? OpenChunk(header, data_) : TakeRecord(header, data_, message, found);
}

Fault Ros1Reader::OpenChunk(const Header& header, std::span<std::uint8_t> data) {
  if (header.size > kMostMessageBytes) return file_.Corrupt(chunk_begin_, "a chunk is too long");
  const std::uint64_t weight = header.compression == "bz2" ? UnpackedTotal::kBzip2Weight : 1;
  if (!total_.Add(header.size, at_, weight))
    return file_.Corrupt(chunk_begin_, UnpackedTotal::kRefusal);
  chunk_.resize(header.size);
  const std::string_view compression =
      header.compression == "none" ? std::string_view() : header.compression;
  const Fault fault = Decompress(compression, data, chunk_);
  if (!fault.ok()) return file_.Corrupt(chunk_begin_, fault.message);
  chunk_rest_ = chunk_;
  return {};
}

Fault Ros1Reader::TakeFromChunk(BagMessage& message, bool& found) {
  ByteCursor cursor(chunk_rest_);
  const auto header_bytes = cursor.TakeBytes(cursor.Take<std::uint32_t>());
  const auto data = cursor.TakeBytes(cursor.Take<std::uint32_t>());
  chunk_rest_ = cursor.ok() ? cursor.rest() : std::span<std::uint8_t>();
  Header header;
  if (cursor.ok() && ReadHeader(header_bytes, header) && header.op != 0)
    return TakeRecord(header, data, message, found);
  chunk_rest_ = {};
  return file_.Corrupt(chunk_begin_, "a record in this chunk is damaged");
}

Fault Ros1Reader::TakeRecord(const Header& header, std::span<std::uint8_t> data,
                             BagMessage& message, bool& found) {
  if (header.op == kConnection) return TakeConnection(header, data);
  if (header.op != kMessage) return {};
  const auto connection = connections_.find(header.connection);
  if (connection == connections_.end()) return {};
  message.serialization = Serialization::kRos1;
  message.type = connection->second;
  message.data = data;
  found = true;
  return {};
}

/// @param data The connection's own header, which names the type.
Fault Ros1Reader::TakeConnection(const Header& header, std::span<std::uint8_t> data) {
  Header connection;
  if (!ReadHeader(data, connection)) return file_.Corrupt(chunk_begin_, "a connection is damaged");
  names_.Add(header.topic, connection.type);
  if (header.topic != topic_ || connections_.size() >= kMostConnections) return {};
  connections_[header.connection] = connection.type.substr(0, kLongestTypeName);
  return {};
}

}  // namespace disflow::posix
