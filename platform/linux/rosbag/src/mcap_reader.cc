// SPDX-License-Identifier: BSD-3-Clause
#include "mcap_reader.h"

#include <algorithm>

#include "mcap_format.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

/// Of a schema's or channel's texts; definitions of messages have some thousand bytes.
constexpr std::uint64_t kMostTextBytes = std::uint64_t{1} << 20U;
constexpr std::size_t kLongestName = 255;
constexpr std::size_t kMostChannels = 4096;

}  // namespace

Fault McapReader::Open(const std::filesystem::path& file, const std::string& topic) {
  topic_ = topic;
  const Fault fault = file_.Open(file);
  return fault.ok() ? CheckEnds() : fault;
}

/// A file that was closed ends with a footer and the bytes with which it begins.
Fault McapReader::CheckEnds() {
  std::array<std::uint8_t, mcap::kMagic.size()> magic{};
  if (file_.size() < magic.size()) return file_.Corrupt(0, "is too short for an MCAP file");
  Fault fault = file_.Read(0, magic);
  if (!fault.ok()) return fault;
  if (magic != mcap::kMagic) return file_.Corrupt(0, "is no MCAP file");
  at_ = magic.size();
  if (file_.size() < 2 * magic.size()) return {};
  fault = file_.Read(file_.size() - magic.size(), magic);
  closed_ = magic == mcap::kMagic;
  return fault.ok() && closed_ ? FindChecksum() : fault;
}

/// Whether the record before the summary holds a checksum.
Fault McapReader::FindChecksum() {
  constexpr std::uint64_t kEnd = mcap::kMagic.size() + mcap::kFooterBytes + mcap::kRecordHeadBytes;
  constexpr std::uint64_t kDataEnd = mcap::kRecordHeadBytes + mcap::kDataEndBytes;
  std::array<std::uint8_t, mcap::kRecordHeadBytes + mcap::kFooterBytes> footer{};
  if (file_.size() < at_ + kEnd) return {};
  Fault fault = file_.Read(file_.size() - kEnd, footer);
  if (!fault.ok() || footer[0] != mcap::kFooter) return fault;
  ByteCursor cursor(std::span<std::uint8_t>(footer).subspan(mcap::kRecordHeadBytes));
  const auto summary = cursor.Take<std::uint64_t>();
  const std::uint64_t end = summary == 0 ? file_.size() - kEnd : summary;
  if (end < at_ + kDataEnd || end > file_.size()) return {};
  std::array<std::uint8_t, kDataEnd> data_end{};
  fault = file_.Read(end - kDataEnd, data_end);
  ByteCursor checksum(std::span<std::uint8_t>(data_end).subspan(mcap::kRecordHeadBytes));
  has_checksum_ =
      fault.ok() && data_end[0] == mcap::kDataEnd && checksum.Take<std::uint32_t>() != 0;
  return fault;
}

std::string McapReader::note() const { return closed_ ? "" : file_.CutShort(); }

Fault McapReader::ReadHead(std::uint64_t begin, Record& record) {
  std::array<std::uint8_t, mcap::kRecordHeadBytes> head{};
  const Fault fault = file_.Read(begin, head);
  ByteCursor cursor(head);
  record.opcode = cursor.Take<std::uint8_t>();
  record.length = cursor.Take<std::uint64_t>();
  record.begin = begin + head.size();
  return fault;
}

Fault McapReader::ReadContent(const Record& record, std::uint64_t most) {
  if (record.length > most) return file_.Corrupt(record.begin, "a record is too long");
  content_.resize(static_cast<std::size_t>(record.length));
  return file_.Read(record.begin, content_);
}

/// Goes on with the checksum of all bytes until `end`.
Fault McapReader::AddToChecksum(std::uint64_t end) {
  std::array<std::uint8_t, 65536> block;
  while (has_checksum_ && checked_ < end) {
    const auto part = std::span(block).first(
        static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), end - checked_)));
    const Fault fault = file_.Read(checked_, part);
    if (!fault.ok()) return fault;
    checksum_ = mcap::Crc32(checksum_, part);
    checked_ += part.size();
  }
  return {};
}

Fault McapReader::Next(BagMessage& message) {
  for (bool found = false;;) {
    const Fault fault =
        chunk_rest_.empty() ? TakeFromFile(message, found) : TakeFromChunk(message, found);
    if (!fault.ok() || found) return fault;
  }
}

Fault McapReader::TakeFromFile(BagMessage& message, bool& found) {
  const Fault over = file_.IsOver();
  if (file_.size() - at_ < mcap::kRecordHeadBytes) return over;
  Record record;
  Fault fault = ReadHead(at_, record);
  if (!fault.ok()) return Stop(), fault;
  const std::uint64_t begin = at_;
  if (record.length > file_.size() - record.begin) {
    Stop();
    // What a killed recorder leaves is said by note().
    return closed_ ? file_.Corrupt(begin, "a record is longer than the file") : over;
  }
  if (fault = AddToChecksum(begin); !fault.ok()) return Stop(), fault;
  at_ = record.begin + record.length;
  switch (record.opcode) {
    case mcap::kSchema:
    case mcap::kChannel:
      fault = ReadContent(record, kMostTextBytes);
      break;
    case mcap::kMessage:
      fault = ReadContent(record, kMostMessageBytes);
      break;
    case mcap::kChunk:
      return OpenChunk(record);
    case mcap::kDataEnd:
      return TakeDataEnd(record);
    case mcap::kFooter:
      Stop();
      return over;
    case 0:
      Stop();
      return file_.Corrupt(begin, "is no record; what follows cannot be read");
    default:
      return {};
  }
  return fault.ok() ? TakeRecord(record.opcode, content_, message, found) : fault;
}

/// The data section is over; what follows is an index.
Fault McapReader::TakeDataEnd(const Record& record) {
  Fault fault = ReadContent(record, kMostTextBytes);
  Stop();
  if (!fault.ok() || !has_checksum_) return fault;
  ByteCursor cursor(content_);
  if (cursor.Take<std::uint32_t>() == checksum_) return {};
  return file_.Corrupt(record.begin, "the checksum says that something before is damaged");
}

Fault McapReader::OpenChunk(const Record& record) {
  if (record.length > kMostMessageBytes) return file_.Corrupt(record.begin, "a chunk is too long");
  Fault fault = ReadContent(record, kMostMessageBytes);
  if (!fault.ok()) return fault;
  ByteCursor cursor(content_);
  (void)cursor.Take<std::uint64_t>();  // times
  (void)cursor.Take<std::uint64_t>();
  const auto size = cursor.Take<std::uint64_t>();
  const auto checksum = cursor.Take<std::uint32_t>();
  const std::string_view compression = cursor.TakeText();
  const auto packed = cursor.TakeBytes(cursor.Take<std::uint64_t>());
  if (!cursor.ok()) return file_.Corrupt(record.begin, "a chunk is not whole");
  if (size > kMostMessageBytes) return file_.Corrupt(record.begin, "a chunk is too long");
  if (!total_.Add(size, at_)) return file_.Corrupt(record.begin, UnpackedTotal::kRefusal);
  chunk_.resize(static_cast<std::size_t>(size));
  fault = Decompress(compression, packed, chunk_);
  if (!fault.ok()) return file_.Corrupt(record.begin, fault.message);
  if (checksum != 0 && checksum != mcap::Crc32(0, chunk_))
    return file_.Corrupt(record.begin, "the checksum of a chunk is wrong, so it is left out");
  chunk_rest_ = chunk_;
  chunk_begin_ = record.begin;
  return {};
}

Fault McapReader::TakeFromChunk(BagMessage& message, bool& found) {
  ByteCursor cursor(chunk_rest_);
  const auto opcode = cursor.Take<std::uint8_t>();
  const auto content = cursor.TakeBytes(cursor.Take<std::uint64_t>());
  chunk_rest_ = cursor.ok() ? cursor.rest() : std::span<std::uint8_t>();
  if (!cursor.ok()) return file_.Corrupt(chunk_begin_, "a record is longer than its chunk");
  if (opcode == 0) {
    chunk_rest_ = {};
    return file_.Corrupt(chunk_begin_, "a chunk holds what is no record; the rest is left out");
  }
  return TakeRecord(opcode, content, message, found);
}

Fault McapReader::TakeRecord(std::uint8_t opcode, std::span<std::uint8_t> content,
                             BagMessage& message, bool& found) {
  ByteCursor cursor(content);
  if (opcode == mcap::kSchema) return TakeSchema(cursor);
  if (opcode == mcap::kChannel) return TakeChannel(cursor);
  if (opcode != mcap::kMessage) return {};
  const auto channel = channels_.find(cursor.Take<std::uint16_t>());
  if (channel == channels_.end()) return {};
  (void)cursor.TakeBytes(mcap::kMessageHeadBytes - sizeof(std::uint16_t));
  if (!cursor.ok()) return file_.Corrupt(chunk_begin_, "a message is too short");
  message.serialization = channel->second.serialization;
  message.type = channel->second.type;
  message.data = cursor.rest();
  const Fault fault = DecompressMessage(message_, message.data, total_, at_);
  found = fault.ok();
  return found ? fault : file_.Corrupt(at_, fault.message);
}

Fault McapReader::TakeSchema(ByteCursor cursor) {
  const auto id = cursor.Take<std::uint16_t>();
  const std::string_view name = cursor.TakeText();
  if (!cursor.ok()) return file_.Corrupt(at_, "a schema is not whole");
  if (name.size() > kLongestName || schemas_.size() >= kMostChannels) return {};
  schemas_.emplace(id, name);
  return {};
}

Fault McapReader::TakeChannel(ByteCursor cursor) {
  const auto id = cursor.Take<std::uint16_t>();
  const auto schema = cursor.Take<std::uint16_t>();
  const std::string_view topic = cursor.TakeText();
  const std::string_view encoding = cursor.TakeText();
  if (!cursor.ok()) return file_.Corrupt(at_, "a channel is not whole");
  const auto type = schemas_.find(schema);
  names_.Add(topic, type == schemas_.end() ? "" : type->second);
  if (topic != topic_ || channels_.size() >= kMostChannels) return {};
  if (encoding != "cdr" && encoding != "ros1") {
    return MakeFault(Status::kUnsupported, "%s: %s is encoded as '%s'; cdr (ROS 2) can be read",
                     file_.path().c_str(), topic_.c_str(), ShownText(encoding, 20).c_str());
  }
  channels_[id] = {type == schemas_.end() ? "" : type->second,
                   encoding == "cdr" ? Serialization::kCdr : Serialization::kRos1};
  return {};
}

}  // namespace disflow::posix
