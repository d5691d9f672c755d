// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <random>
#include <string>

#include "bag_fixture.h"
#include "chunk_decompressor.h"

// A few bytes that unpack to many: what they may cost is bounded by the length of the file.
namespace disflow::posix {
namespace {

constexpr std::uint64_t kMega = 1 << 20U;
constexpr std::size_t kBombs = 20;
constexpr std::uint64_t kBomb_bytes = 60 * kMega;

TEST(UnpackedTotal, WhatIsAllowed_GrowsWithTheFileAndWhatIsRefusedIsNotCounted) {
  UnpackedTotal total;
  EXPECT_TRUE(total.Add(256 * kMega, 0));
  EXPECT_FALSE(total.Add(1, 0));
  EXPECT_FALSE(total.Add(2001, 1));
  EXPECT_TRUE(total.Add(2000, 1));
  EXPECT_FALSE(total.Add(1, 1));
  EXPECT_FALSE(total.Add(~std::uint64_t{0} - 300 * kMega, 1'000'000));
}

TEST(UnpackedTotal, SlowBytes_CountAsManyOthers) {
  UnpackedTotal total;
  constexpr std::uint64_t kFree = UnpackedTotal::kFree_bytes / UnpackedTotal::kBzip2Weight;
  EXPECT_FALSE(total.Add(kFree + 1, 0, UnpackedTotal::kBzip2Weight));
  EXPECT_TRUE(total.Add(kFree + 25 * kMega, kMega, UnpackedTotal::kBzip2Weight));
  EXPECT_FALSE(total.Add(80, kMega));
}

class BagBombTest : public BagSensorTest {
 protected:
  /// An image, zeros on a topic that nobody asks for, and intrinsics.
  [[nodiscard]] std::vector<RecordedMessage> Start(std::size_t zeros) const {
    return {{kDepth, messages_[1].type, messages_[1].data},
            {"/zeros", "std_msgs/msg/String", Bytes(zeros, '\0')},
            messages_[2]};
  }
  /// The same image and many zeros, in one chunk.
  [[nodiscard]] std::vector<RecordedMessage> Bomb(std::size_t bytes = kBomb_bytes) const {
    std::vector<RecordedMessage> messages = Start(bytes);
    messages.pop_back();
    return messages;
  }

  /// Of the bombs those are unpacked that there is room for, the others are said to be lost.
  void ExpectFewUnpacked(const fs::path& file, std::uint64_t weight = 1) {
    ASSERT_LT(fs::file_size(file), kMega);
    const std::uint64_t bomb_bytes = kBomb_bytes / weight;
    const std::uint64_t free_bytes = UnpackedTotal::kFree_bytes / weight;
    const std::uint64_t allowed_bytes =
        free_bytes + UnpackedTotal::kMostTimes * fs::file_size(file) / weight;
    ASSERT_LT(allowed_bytes, kBombs / 2 * bomb_bytes);
    BagSensor sensor(Options(file));
    const hal::Fault opened = sensor.Open();
    ASSERT_TRUE(opened.ok()) << opened.message;
    const std::vector<Played> frames = PlayAll(sensor);
    ASSERT_EQ(frames.size(), kBombs + 1);
    std::size_t unpacked = 0;
    for (const Played& played : frames) {
      if (played.fault.ok()) {
        ExpectFrame(played, 0);
        ++unpacked;
        continue;
      }
      EXPECT_EQ(played.fault.status, Status::kCorrupt);
      EXPECT_NE(std::string(played.fault.message).find("too long for so short a file"),
                std::string::npos)
          << played.fault.message;
    }
    EXPECT_GE(unpacked, 1 + free_bytes / bomb_bytes);
    EXPECT_LE(unpacked, 1 + allowed_bytes / bomb_bytes);
  }

  void ExpectPlayedWhole(const fs::path& file) const {
    BagSensor sensor(Options(file));
    const hal::Fault opened = sensor.Open();
    ASSERT_TRUE(opened.ok()) << opened.message;
    const std::vector<Played> frames = PlayAll(sensor);
    EXPECT_EQ(std::count_if(frames.begin(), frames.end(),
                            [](const Played& played) { return played.fault.ok(); }),
              kFrames);
  }
};

Bytes Repeated(const Bytes& start, const Bytes& part) {
  Bytes file = start;
  for (std::size_t k = 0; k < kBombs; ++k) file += part;
  return file;
}

TEST_F(BagBombTest, ChunksOfMcap_AreUnpackedAsFarAsTheFilesLengthAllows) {
  const McapStyle style{.compression = "zstd", .checksums = false, .closed = false};
  const Bytes bomb = McapFile(Bomb(), style).substr(McapFile({}, style).size());
  ExpectFewUnpacked(dir_.Write("a.mcap", Repeated(McapFile(Start(1), style), bomb)));
}

TEST_F(BagBombTest, ChunksOfABag_AreUnpackedAsFarAsTheFilesLengthAllows) {
  WriteAs(Wire::kRos1);
  std::swap(messages_[2], messages_[0]);
  constexpr std::uint64_t kWeight = UnpackedTotal::kBzip2Weight;
  const Bytes bomb = Ros1Bag(Bomb(kBomb_bytes / kWeight), "bz2").substr(Ros1Bag({}, "bz2").size());
  ExpectFewUnpacked(dir_.Write("a.bag", Repeated(Ros1Bag(Start(1), "bz2"), bomb)), kWeight);
}

TEST_F(BagBombTest, BagThatPacksTwentyTimesWithBzip2_IsPlayedWhole) {
  constexpr std::size_t kImage_bytes = 6 * 300'000;  // its rows lie far apart
  constexpr std::size_t kNoise_bytes = kImage_bytes / 22;
  std::mt19937 random(1);
  std::vector<RecordedMessage> messages{messages_[2]};
  messages[0].data = CameraInfoMessage(StampOf(0), 10.0, 8, 6, Wire::kRos1);
  for (int k = 0; k < kFrames; ++k) {
    TestImage image{StampOf(k), "16UC1", 8, 6, Bytes(kImage_bytes, '\0')};
    for (std::size_t i = 0; i < kNoise_bytes; ++i)
      image.data[i] = static_cast<char>(random() & 0xFFU);
    messages.push_back({kDepth, kImageType, ImageMessage(image, Wire::kRos1)});
  }
  const fs::path file = dir_.Write("a.bag", Ros1Bag(messages, "bz2"));
  ASSERT_GT(kFrames * kImage_bytes, 20 * fs::file_size(file));
  ASSERT_GT(kFrames * kImage_bytes, 2 * UnpackedTotal::kFree_bytes / UnpackedTotal::kBzip2Weight);
  ExpectPlayedWhole(file);
}

TEST_F(BagBombTest, MessagesThatArePackedByThemselves_AreUnpackedAsFarAsTheFilesLengthAllows) {
  Bytes large = messages_[1].data;
  large.resize(kBomb_bytes, '\0');  // What follows the image is of no use and does no harm.
  std::vector<RecordedMessage> messages{messages_[2], messages_[1]};
  for (std::size_t k = 0; k < kBombs; ++k) messages.push_back({kDepth, kImageType, Zstd(large)});
  const fs::path database = dir_.path() / "a.db3";
  WriteDb3(database, messages);
  ExpectFewUnpacked(database);
  ExpectFewUnpacked(dir_.Write("a.mcap", McapFile(messages, {})));
  // Packed twice, the file's bytes count and not those of the chunk.
  ExpectFewUnpacked(dir_.Write("b.mcap", McapFile(messages, {.compression = "zstd"})));
}

TEST_F(BagBombTest, ShortRecordingOfNothing_IsPlayedHoweverWellItPacks) {
  constexpr std::size_t kImage_bytes = 6 * 300'000;  // its rows lie far apart
  std::vector<RecordedMessage> messages{messages_[2]};
  for (int k = 0; k < kFrames; ++k) {
    const TestImage image{StampOf(k), "16UC1", 8, 6, Bytes(kImage_bytes, '\0')};
    messages.push_back({kDepth, kImageType, ImageMessage(image)});
  }
  const fs::path file = dir_.Write("a.mcap", McapFile(messages, {.compression = "zstd"}));
  ASSERT_LT(fs::file_size(file) * UnpackedTotal::kMostTimes, kFrames * kImage_bytes);
  ExpectPlayedWhole(file);
}

TEST_F(BagBombTest, TenThousandDamagedImagesAtTheStart_AreEnough) {
  std::vector<RecordedMessage> messages{messages_[2]};
  for (int k = 0; k < 10'000; ++k) messages.push_back({kDepth, kImageType, "x"});
  messages.push_back(messages_[1]);
  const McapStyle style{.chunked = false, .checksums = false};
  ExpectRefused(Options(dir_.Write("a.mcap", McapFile(messages, style))), Status::kTruncated,
                "image 0");
  messages.erase(messages.begin() + 1);
  EXPECT_TRUE(BagSensor(Options(dir_.Write("b.mcap", McapFile(messages, style)))).Open().ok());
}

}  // namespace
}  // namespace disflow::posix
