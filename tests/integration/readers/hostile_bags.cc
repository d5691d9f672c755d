// SPDX-License-Identifier: BSD-3-Clause
#include "hostile_bags.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "bag_files.h"

namespace disflow::test {
namespace {

using posix::Bytes;
using posix::McapFile;
using posix::McapStyle;
using posix::RecordedMessage;
using posix::Ros1Bag;
using posix::Wire;

constexpr std::size_t kMegabyte = 1'000'000;
constexpr std::int64_t kHole = std::int64_t{20} << 30;
constexpr std::size_t kBomb_bytes = 60'000'000;
constexpr std::int64_t kStamp_ns = 1'700'000'000'000'000'000;
constexpr const char* kImage = "sensor_msgs/msg/Image";
constexpr const char* kInfo = "sensor_msgs/msg/CameraInfo";
constexpr const char* kImageOfRos1 = "sensor_msgs/Image";
constexpr const char* kInfoOfRos1 = "sensor_msgs/CameraInfo";
constexpr const char* kOther = "std_msgs/msg/String";

RecordedMessage Info(Wire wire = Wire::kLittle) {
  return {kHostileInfo, wire == Wire::kRos1 ? kInfoOfRos1 : kInfo,
          posix::CameraInfoMessage(kStamp_ns, 10.0, 8, 6, wire)};
}
RecordedMessage LargeInfo(std::uint32_t side_px) {
  posix::CdrWriter writer;
  writer.AddHeader(kStamp_ns).Add(side_px).Add(side_px).AddText("plumb_bob").Add(std::uint32_t{0});
  const double f = side_px;
  const double c = 0.5 * side_px;
  for (const double k : {f, 0.0, c, 0.0, f, c, 0.0, 0.0, 1.0}) writer.Add(k);
  for (const double r : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) writer.Add(r);
  for (const double p : {f, 0.0, c, 0.0, 0.0, f, c, 0.0, 0.0, 0.0, 1.0, 0.0}) writer.Add(p);
  for (int i = 0; i < 6; ++i) writer.Add(std::uint32_t{0});
  return {kHostileInfo, kInfo, writer.Add(std::uint8_t{0}).bytes()};
}
RecordedMessage Image(Wire wire = Wire::kLittle) {
  return {kHostileDepth, wire == Wire::kRos1 ? kImageOfRos1 : kImage,
          posix::ImageMessage({kStamp_ns, "16UC1", 8, 6, Bytes(96, '\1')}, wire)};
}
RecordedMessage Zeros(std::size_t size) { return {"/zeros", kOther, Bytes(size, '\0')}; }

std::vector<RecordedMessage> Start(Wire wire = Wire::kLittle) { return {Info(wire), Image(wire)}; }

/// As many messages as make a megabyte.
template <class Make>
std::vector<RecordedMessage> Many(std::size_t bytes_each, Make&& make) {
  std::vector<RecordedMessage> messages = Start();
  for (std::size_t i = 0; i < kMegabyte / bytes_each; ++i) messages.push_back(make(i));
  return messages;
}

/// What packs a thousand times, behind a good start, as often as fits.
Bytes Repeated(const Bytes& start, const Bytes& part) {
  Bytes file = start;
  while (file.size() + part.size() <= kMegabyte) file += part;
  return file;
}
/// Once the zeros are many; topics have the same numbers.
std::vector<RecordedMessage> WithZeros(std::size_t zeros, Wire wire) {
  return {Info(wire), Image(wire), Zeros(zeros)};
}

Bytes McapOfBombs(const char* compression) {
  const McapStyle style{.compression = compression, .checksums = false, .closed = false};
  const Bytes bomb =
      McapFile(WithZeros(kBomb_bytes, Wire::kLittle), style).substr(McapFile({}, style).size());
  return Repeated(McapFile(WithZeros(1, Wire::kLittle), style), bomb);
}
std::string McapOfZstdBombs() { return McapOfBombs("zstd"); }
std::string McapOfLz4Bombs() { return McapOfBombs("lz4"); }
std::string McapOfPackedMessages() {
  const Bytes packed = posix::Zstd(Bytes(kBomb_bytes, '\0'));
  return McapFile(Many(packed.size() + 100,
                       [&](std::size_t) {
                         return RecordedMessage{kHostileDepth, kImage, packed};
                       }),
                  {.chunked = false});
}
std::string McapOfDamagedImages() {
  return McapFile(Many(60,
                       [](std::size_t) {
                         return RecordedMessage{kHostileDepth, kImage, "x"};
                       }),
                  {.chunked = false});
}
std::string McapOfTopics() {
  return McapFile(Many(140,
                       [](std::size_t i) {
                         return RecordedMessage{"/topic" + std::to_string(i), kOther, "x"};
                       }),
                  {.chunked = false});
}
std::string McapOfChunks() {
  return McapFile(Many(120, [](std::size_t) { return Zeros(1); }), {.per_chunk = 1});
}
std::string McapOfLongRecord() {
  Bytes file = McapFile(Start(), {.chunked = false, .closed = false});
  const std::uint64_t length = ~std::uint64_t{0} - 5;
  Bytes head(1, '\5');
  head.resize(1 + sizeof(length));
  std::memcpy(head.data() + 1, &length, sizeof(length));
  return file + head;
}
std::string McapOfAHole() { return McapFile(Start(), {.chunked = false, .closed = false}); }

/// Sixteen million pixels of one value, with a mask: as large as images may be.
std::string McapOfOneLargeImage() {
  constexpr std::uint32_t kSide_px = 4096;
  constexpr std::size_t kPixels = std::size_t{kSide_px} * kSide_px;
  const auto image = [](const char* encoding, std::size_t bytes) {
    return posix::ImageMessage({kStamp_ns, encoding, kSide_px, kSide_px, Bytes(bytes, '\1')});
  };
  return McapFile({LargeInfo(kSide_px),
                   {kHostileDepth, kImage, image("16UC1", 2 * kPixels)},
                   {kHostileMask, kImage, image("mono8", kPixels)}},
                  {.compression = "zstd", .per_chunk = 1});
}

Bytes BagOfBombs(const char* compression) {
  const Bytes bomb = Ros1Bag(WithZeros(kBomb_bytes, Wire::kRos1), compression)
                         .substr(Ros1Bag({}, compression).size());
  return Repeated(Ros1Bag(WithZeros(1, Wire::kRos1), compression), bomb);
}
std::string BagOfBzip2Bombs() { return BagOfBombs("bz2"); }
/// Fibonacci words: 900,000 bytes, a whole block of bz2, pack into 66, and unpacking them goes all
/// over that block's memory.
std::string BagOfBzip2Words() {
  constexpr std::size_t kBlock_bytes = 899'000;
  Bytes word = "a";
  for (Bytes next = "ab"; word.size() < kBlock_bytes;) word = std::exchange(next, next + word);
  word.resize(kBlock_bytes);
  const Bytes part =
      Ros1Bag({Info(Wire::kRos1), Image(Wire::kRos1), {"/words", kOther, word}}, "bz2")
          .substr(Ros1Bag({}, "bz2").size());
  return Repeated(Ros1Bag(WithZeros(1, Wire::kRos1), "bz2"), part);
}
std::string BagOfLz4Bombs() { return BagOfBombs("lz4"); }
std::string BagOfTopics() {
  std::vector<RecordedMessage> messages = Start(Wire::kRos1);
  for (std::size_t i = 0; i < kMegabyte / 250; ++i)
    messages.push_back({"/topic" + std::to_string(i), kOther, "x"});
  return Ros1Bag(messages, "none");
}
std::string BagOfEmptyRecords() {
  // A header without a field, and no data.
  return Repeated(Ros1Bag(Start(Wire::kRos1), "none"), Bytes(8, '\0'));
}
std::string BagOfOneHeader() {
  Bytes file = Ros1Bag(Start(Wire::kRos1), "none", /*closed=*/false);
  return file + Bytes(4, '\x7F') + Bytes(1000, 'a');
}
std::string BagOfAHole() { return Ros1Bag(Start(Wire::kRos1), "none", /*closed=*/false); }

/// What a database is in bytes, after `change` has had its way with it.
template <class Change>
Bytes Database(const std::vector<RecordedMessage>& messages, Change&& change) {
  namespace fs = std::filesystem;
  std::string folder = (fs::temp_directory_path() / "disflow_hostile_XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) return {};
  const fs::path file = fs::path(folder) / "a.db3";
  change(file);
  posix::WriteDb3(file, messages);
  std::ifstream stream(file, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(stream), {}};
  fs::remove_all(folder);
  return bytes;
}
Bytes Database(const std::vector<RecordedMessage>& messages) {
  return Database(messages, [](const std::filesystem::path&) {});
}
std::string DatabaseOfTopics() {
  return Database(Many(150, [](std::size_t i) {
    return RecordedMessage{"/topic" + std::to_string(i), kOther, "x"};
  }));
}
std::string DatabaseOfDamagedImages() {
  return Database(Many(60, [](std::size_t) {
    return RecordedMessage{kHostileDepth, kImage, "x"};
  }));
}
std::string DatabaseOfPackedMessages() {
  const Bytes packed = posix::Zstd(Bytes(kBomb_bytes, '\0'));
  return Database(Many(packed.size() + 4100, [&](std::size_t) {
    return RecordedMessage{kHostileDepth, kImage, packed};
  }));
}
std::string DatabaseOfAHole() { return Database(Start()); }

/// Pages of a few rows and, above them, pages that name the same page below again and again.
std::string DatabaseWithoutEnd() {
  constexpr std::size_t kPage_bytes = 512;
  constexpr std::size_t kLevels = 8;
  std::vector<RecordedMessage> messages = Start();
  messages.push_back({kHostileDepth, kImage, Bytes(kPage_bytes * (kLevels + 1), 'x')});
  Bytes file = Database(messages, [](const std::filesystem::path& path) {
    posix::Execute(path, "PRAGMA page_size=512; VACUUM;");
  });
  const auto big = [](std::size_t value, std::size_t bytes) {
    Bytes text;
    for (std::size_t i = bytes; i-- > 0;) text += static_cast<char>(value >> (8 * i) & 0xFFU);
    return text;
  };
  const auto page_of = [&](char kind, const Bytes& cell, const Bytes& last) {
    const std::size_t count = (kPage_bytes - 8 - last.size()) / (cell.size() + 2);
    Bytes places;
    Bytes cells;
    for (std::size_t i = 0; i < count; ++i) {
      cells += cell;
      places += big(kPage_bytes - cells.size(), 2);
    }
    Bytes page = kind + Bytes(2, '\0') + big(count, 2) + big(kPage_bytes - cells.size(), 2) +
                 Bytes(1, '\0') + last + places;
    page.resize(kPage_bytes - cells.size());
    return page + cells;
  };
  const auto put = [&](std::size_t number, const Bytes& page) {
    file.replace((number - 1) * kPage_bytes, kPage_bytes, page);
  };
  // The table's root stands behind the schema and the topics, the large row's pages at the end.
  constexpr std::size_t kRoot = 3;
  std::size_t below = file.size() / kPage_bytes;
  // Its length, its number, and as columns nothing, nine, nothing and nothing: of no topic.
  put(below, page_of('\x0D', Bytes("\6\1\5\0\1\0\0\x09", 8), ""));
  for (std::size_t level = 0; level < kLevels; ++level) {
    const std::size_t number = level + 1 < kLevels ? below - 1 : kRoot;
    put(number, page_of('\5', big(below, 4) + '\1', big(below, 4)));
    below = number;
  }
  return file;
}

}  // namespace

const std::vector<HostileBag>& HostileBags() {
  static const std::vector<HostileBag> bags{
      {"McapOfZstdBombs", "a.mcap", McapOfZstdBombs, "too long for so short a file"},
      {"McapOfLz4Bombs", "a.mcap", McapOfLz4Bombs},
      {"McapOfPackedMessages", "a.mcap", McapOfPackedMessages, "image 1"},
      {"McapOfDamagedImages", "a.mcap", McapOfDamagedImages, "image 1"},
      {"McapOfTopics", "a.mcap", McapOfTopics},
      {"McapOfChunks", "a.mcap", McapOfChunks},
      {"McapOfLongRecord", "a.mcap", McapOfLongRecord},
      {"McapOfAHole", "a.mcap", McapOfAHole, "is no record", kHole},
      {"McapOfOneLargeImage", "a.mcap", McapOfOneLargeImage, "", -1, true},
      {"BagOfBzip2Bombs", "a.bag", BagOfBzip2Bombs, "too long for so short a file"},
      // 1 to 3 s, 13 where memory is slow; it would be hours.
      {"BagOfBzip2Words", "a.bag", BagOfBzip2Words, "too long for so short a file", -1, false, 60},
      {"BagOfLz4Bombs", "a.bag", BagOfLz4Bombs},
      {"BagOfTopics", "a.bag", BagOfTopics},
      {"BagOfEmptyRecords", "a.bag", BagOfEmptyRecords, "is no record"},
      {"BagOfOneHeader", "a.bag", BagOfOneHeader},
      {"BagOfAHole", "a.bag", BagOfAHole, "is no record", kHole},
      {"DatabaseOfTopics", "a.db3", DatabaseOfTopics},
      {"DatabaseOfDamagedImages", "a.db3", DatabaseOfDamagedImages, "image 1"},
      {"DatabaseOfPackedMessages", "a.db3", DatabaseOfPackedMessages, "image 1"},
      {"DatabaseOfAHole", "a.db3", DatabaseOfAHole, "", kHole},
      {"DatabaseWithoutEnd", "a.db3", DatabaseWithoutEnd, "interrupted"},
  };
  return bags;
}

}  // namespace disflow::test
