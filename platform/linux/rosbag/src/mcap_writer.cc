// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/rosbag/mcap_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "byte_cursor.h"
#include "byte_sink.h"
#include "mcap_format.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

/// Of a chunk that is not packed: times, size, checksum, no name of a packing, size.
constexpr std::uint64_t kChunkHeadBytes = 40;
constexpr std::size_t kRecordsAt = mcap::kRecordHeadBytes + kChunkHeadBytes;

std::uint16_t IdOf(std::size_t channel) { return static_cast<std::uint16_t>(channel + 1); }

/// Appends a record whose length is known when its content is.
template <class Fill>
void AppendRecord(std::uint8_t opcode, std::vector<std::uint8_t>& bytes, Fill&& fill) {
  std::vector<std::uint8_t> content;
  fill(ByteSink(content));
  ByteSink(bytes).PutHead(opcode, content.size()).PutBytes(content);
}

}  // namespace

Fault McapWriter::FileFault() const {
  const int error = errno;
  const Status status = error == EEXIST   ? Status::kBusy
                        : error == EACCES ? Status::kPermissionDenied
                                          : Status::kIoError;
  return MakeFault(status, "%s: cannot be written: %s", file_.c_str(), std::strerror(error));
}

Fault McapWriter::Open(const std::filesystem::path& file,
                       const std::vector<McapChannel>& channels) {
  file_ = file;
  channels_ = channels;
  counts_.assign(channels.size(), 0);
  descriptor_ = FileDescriptor(RetryOnSignal(
      [&] { return ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666); }));
  if (!descriptor_.is_open()) return failure_ = FileFault();
  std::vector<std::uint8_t> begin(mcap::kMagic.begin(), mcap::kMagic.end());
  AppendRecord(mcap::kHeader, begin,
               [](ByteSink sink) { sink.PutText("ros2").PutText("disflow_track"); });
  AppendChannels(begin);
  chunk_.assign(kRecordsAt, 0);
  const Fault fault = Write(begin);
  data_begin_ = size_;
  return fault;
}

void McapWriter::AppendChannels(std::vector<std::uint8_t>& bytes) const {
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const McapChannel& channel = channels_[i];
    AppendRecord(mcap::kSchema, bytes, [&](ByteSink sink) {
      sink.Put(IdOf(i)).PutText(channel.type).PutText("ros2msg").PutText(channel.schema);
    });
    AppendRecord(mcap::kChannel, bytes, [&](ByteSink sink) {
      sink.Put(IdOf(i)).Put(IdOf(i)).PutText(channel.topic).PutText("cdr");
      sink.Put(std::uint32_t{0});
    });
  }
}

/// All or nothing: what could not be written wholly is taken back.
Fault McapWriter::Write(std::span<const std::uint8_t> bytes) {
  if (!failure_.ok()) return failure_;
  std::uint64_t at = size_;
  while (!bytes.empty()) {
    const ssize_t written = RetryOnSignal([&] {
      return ::pwrite(descriptor_.get(), bytes.data(), bytes.size(), static_cast<off_t>(at));
    });
    if (written <= 0) {
      failure_ = FileFault();
      // If this fails too, the file ends within a chunk, as after a kill: readers know of that.
      (void)(::ftruncate(descriptor_.get(), static_cast<off_t>(size_)) == 0);
      return failure_;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    at += static_cast<std::uint64_t>(written);
  }
  size_ = at;
  return {};
}

Fault McapWriter::Read(std::uint64_t begin, std::span<std::uint8_t> bytes) const {
  const ssize_t count = RetryOnSignal([&] {
    return ::pread(descriptor_.get(), bytes.data(), bytes.size(), static_cast<off_t>(begin));
  });
  if (count == static_cast<ssize_t>(bytes.size())) return {};
  return MakeFault(Status::kIoError, "%s: its index cannot be written: its chunks cannot be read",
                   file_.c_str());
}

void McapWriter::Add(std::size_t channel, std::int64_t time_ns,
                     std::span<const std::uint8_t> message) {
  const auto time = static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 0));
  entries_.push_back({channel, time, chunk_.size() - kRecordsAt});
  ByteSink sink(chunk_);
  sink.PutHead(mcap::kMessage, mcap::kMessageHeadBytes + message.size());
  sink.Put(IdOf(channel)).Put(static_cast<std::uint32_t>(counts_[channel])).Put(time).Put(time);
  sink.PutBytes(message);
  first_ns_ = messages_ == 0 ? time : std::min(first_ns_, time);
  last_ns_ = std::max(last_ns_, time);
  ++messages_;
  ++counts_[channel];
}

Fault McapWriter::WriteChunk() {
  if (!failure_.ok() || entries_.empty()) return failure_;
  const std::uint64_t records = chunk_.size() - kRecordsAt;
  const auto [first, last] =
      std::minmax_element(entries_.begin(), entries_.end(),
                          [](const Entry& a, const Entry& b) { return a.time_ns < b.time_ns; });
  std::vector<std::uint8_t> head;
  ByteSink(head)
      .PutHead(mcap::kChunk, kChunkHeadBytes + records)
      .Put(first->time_ns)
      .Put(last->time_ns)
      .Put(records)
      .Put(mcap::Crc32(0, std::span(chunk_).subspan(kRecordsAt)))
      .PutText("")
      .Put(records);
  std::copy(head.begin(), head.end(), chunk_.begin());
  for (std::size_t channel = 0; channel < channels_.size(); ++channel) {
    std::vector<std::uint8_t> times;
    for (const Entry& entry : entries_)
      if (entry.channel == channel) ByteSink(times).Put(entry.time_ns).Put(entry.offset);
    if (times.empty()) continue;
    AppendRecord(mcap::kMessageIndex, chunk_, [&](ByteSink sink) {
      sink.Put(IdOf(channel)).PutText({reinterpret_cast<const char*>(times.data()), times.size()});
    });
  }
  const Fault fault = Write(chunk_);
  if (fault.ok()) ++chunks_;
  chunk_.resize(kRecordsAt);
  entries_.clear();
  return fault;
}

void McapWriter::AppendStatistics(std::vector<std::uint8_t>& bytes) const {
  AppendRecord(mcap::kStatistics, bytes, [&](ByteSink sink) {
    const auto channels = static_cast<std::uint32_t>(channels_.size());
    sink.Put(messages_).Put(static_cast<std::uint16_t>(channels)).Put(channels);
    sink.Put(std::uint32_t{0}).Put(std::uint32_t{0}).Put(chunks_);  // attachments, metadata
    sink.Put(first_ns_).Put(last_ns_);
    constexpr std::uint32_t kEntryBytes = 10;
    sink.Put(kEntryBytes * channels);
    for (std::size_t i = 0; i < counts_.size(); ++i) sink.Put(IdOf(i)).Put(counts_[i]);
  });
}

/// Reads the chunk that begins at `at` and its index from the file, so that hours of recording take
/// no memory. @param at Is moved behind them.
Fault McapWriter::AddChunkIndex(std::uint64_t& at, std::vector<std::uint8_t>& summary) {
  const std::uint64_t begin = at;
  std::array<std::uint8_t, kRecordsAt> head{};
  Fault fault = Read(begin, head);
  if (!fault.ok()) return fault;
  ByteCursor chunk(std::span<std::uint8_t>(head).subspan(1));
  const std::uint64_t length = mcap::kRecordHeadBytes + chunk.Take<std::uint64_t>();
  const auto first_ns = chunk.Take<std::uint64_t>();
  const auto last_ns = chunk.Take<std::uint64_t>();
  const auto records = chunk.Take<std::uint64_t>();
  at += length;
  const std::uint64_t index_begin = at;
  std::vector<std::uint8_t> offsets;
  for (std::array<std::uint8_t, mcap::kRecordHeadBytes + 2> index{}; at + index.size() < size_;) {
    fault = Read(at, index);
    if (!fault.ok()) return fault;
    if (index[0] != mcap::kMessageIndex) break;
    ByteCursor cursor(std::span<std::uint8_t>(index).subspan(1));
    const auto index_bytes = cursor.Take<std::uint64_t>();
    ByteSink(offsets).Put(cursor.Take<std::uint16_t>()).Put(at);
    at += mcap::kRecordHeadBytes + index_bytes;
  }
  AppendRecord(mcap::kChunkIndex, summary, [&](ByteSink sink) {
    sink.Put(first_ns).Put(last_ns).Put(begin).Put(length);
    sink.PutText({reinterpret_cast<const char*>(offsets.data()), offsets.size()});
    sink.Put(at - index_begin).PutText("").Put(records).Put(records);
  });
  return {};
}

Fault McapWriter::FlushSummary(std::vector<std::uint8_t>& summary) {
  summary_checksum_ = mcap::Crc32(summary_checksum_, summary);
  const Fault fault = Write(summary);
  summary.clear();
  return fault;
}

Fault McapWriter::WriteSummary() {
  constexpr std::size_t kBlockBytes = 65536;
  const std::uint64_t data_end = size_;
  std::vector<std::uint8_t> bytes;
  ByteSink(bytes).PutHead(mcap::kDataEnd, mcap::kDataEndBytes).Put(std::uint32_t{0});
  Fault fault = Write(bytes);
  const std::uint64_t begin = size_;
  bytes.clear();
  AppendChannels(bytes);
  AppendStatistics(bytes);
  for (std::uint64_t at = data_begin_; fault.ok() && at < data_end;) {
    fault = AddChunkIndex(at, bytes);
    if (fault.ok() && bytes.size() > kBlockBytes) fault = FlushSummary(bytes);
  }
  if (!fault.ok()) return fault;
  ByteSink(bytes).PutHead(mcap::kFooter, mcap::kFooterBytes).Put(begin).Put(std::uint64_t{0});
  fault = FlushSummary(bytes);
  ByteSink(bytes).Put(summary_checksum_).PutBytes(mcap::kMagic);
  return fault.ok() ? Write(bytes) : fault;
}

Fault McapWriter::Close() {
  if (!descriptor_.is_open()) return failure_;
  Fault fault = WriteChunk();
  if (fault.ok()) fault = WriteSummary();
  if (!descriptor_.Close() && fault.ok()) failure_ = fault = FileFault();
  return fault;
}

}  // namespace disflow::posix
