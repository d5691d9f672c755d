// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/mask_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <thread>

#include "eventually.h"
#include "mask_writer.h"

namespace disflow::posix {
namespace {

constexpr int kWidth = 8;
constexpr int kHeight = 6;
constexpr std::int64_t kFrame_ns = 33'333'333;
constexpr std::int64_t kMaxAge_ns = 100'000'000;

class Masks : public ::testing::Test {
 protected:
  /// @return What Attach says of a frame with that stamp; the frame stays in frame_.
  Status Attach(MaskStream& stream, std::int64_t stamp_ns) {
    frame_ = {};
    frame_.depth = {pixels_, kWidth, kHeight, kWidth * 2, DepthFormat::kUint16, 0.001F};
    frame_.stamp_ns = stamp_ns;
    return stream.Attach(frame_);
  }
  [[nodiscard]] bool EveryPixelIs(std::uint8_t value) const {
    if (!frame_.mask.given() || frame_.mask.width_px != kWidth || frame_.mask.height_px != kHeight)
      return false;
    for (int v = 0; v < kHeight; ++v) {
      const std::uint8_t* const row = frame_.mask.row(v);
      if (!std::all_of(row, row + kWidth, [&](std::uint8_t p) { return p == value; })) return false;
    }
    return true;
  }
  [[nodiscard]] std::string Path() const {
    return ::testing::TempDir() + "masks-" + std::to_string(::getpid());
  }
  [[nodiscard]] MaskStream Stream() const {
    return {"file:" + Path(), kWidth, kHeight, kMaxAge_ns};
  }

  std::uint16_t pixels_[kWidth * kHeight] = {};
  DepthFrame frame_;
};

TEST_F(Masks, MaskOfThisFrame_IsUsed) {
  MaskWriter writer(Path());
  MaskStream stream = Stream();
  for (std::uint8_t i = 1; i < 20; ++i) {
    writer.Write(i * kFrame_ns, kWidth, kHeight, i);
    EXPECT_EQ(Attach(stream, i * kFrame_ns), Status::kOk);
    EXPECT_TRUE(EveryPixelIs(i));
  }
  EXPECT_EQ(stream.counters().used, 19U);
}

TEST_F(Masks, RowsWithPadding_AreRead) {
  MaskWriter writer(Path());
  MaskStream stream = Stream();
  writer.Write(1, kWidth, kHeight, 7, 5);
  EXPECT_EQ(Attach(stream, 1), Status::kOk);
  EXPECT_TRUE(EveryPixelIs(7));
}

TEST_F(Masks, WriterThatDied_IsNoticedByItsLastStamp) {
  MaskWriter writer(Path());
  MaskStream stream = Stream();
  writer.Write(0, kWidth, kHeight, 9);
  EXPECT_EQ(Attach(stream, 3 * kFrame_ns), Status::kOk) << "late, but within the allowed age";
  EXPECT_EQ(Attach(stream, 4 * kFrame_ns), Status::kTimeout);
  EXPECT_FALSE(frame_.mask.given());
  EXPECT_EQ(stream.counters().late, 1U);
}

TEST_F(Masks, StampFarFromTheFrames_IsNotUsed) {
  MaskWriter writer(Path());
  MaskStream stream = Stream();
  for (const std::int64_t stamp : {std::numeric_limits<std::int64_t>::min(), std::int64_t{-1},
                                   std::numeric_limits<std::int64_t>::max()}) {
    writer.Write(stamp, kWidth, kHeight, 1);
    EXPECT_EQ(Attach(stream, 10 * kMaxAge_ns), Status::kTimeout);
  }
  EXPECT_EQ(stream.counters().late, 3U);
}

TEST_F(Masks, WriterThatDiedWhileWriting_NeverGivesHalfAMask) {
  MaskWriter writer(Path());
  MaskStream stream = Stream();
  writer.Begin(kFrame_ns, kWidth, kHeight);
  EXPECT_NE(Attach(stream, kFrame_ns), Status::kOk);
  EXPECT_FALSE(frame_.mask.given());
  EXPECT_EQ(stream.counters().torn, 1U);
}

TEST_F(Masks, TornMask_LeavesTheOneBefore) {
  MaskWriter writer(Path());
  MaskStream stream = Stream();
  writer.Write(kFrame_ns, kWidth, kHeight, 3);
  EXPECT_EQ(Attach(stream, kFrame_ns), Status::kOk);
  writer.Begin(2 * kFrame_ns, kWidth, kHeight);
  writer.PutByte(MaskHeader::kSize + 3, 99);
  EXPECT_EQ(Attach(stream, 2 * kFrame_ns), Status::kOk);
  EXPECT_TRUE(EveryPixelIs(3));
  EXPECT_EQ(stream.counters().torn, 1U);
}

TEST_F(Masks, OtherSize_IsRefused) {
  MaskWriter writer(Path());
  MaskStream stream = Stream();
  writer.Write(1, kWidth + 1, kHeight, 1);
  EXPECT_EQ(Attach(stream, 1), Status::kMaskSizeMismatch);
  EXPECT_FALSE(frame_.mask.given());
  writer.Write(2, kWidth, kHeight, 5);
  EXPECT_EQ(Attach(stream, 2), Status::kOk) << "a writer that does better is listened to";
  EXPECT_EQ(stream.counters().wrong_size, 1U);
}

TEST_F(Masks, EveryTruncation_IsRefused) {
  MaskWriter writer(Path());
  for (std::size_t size = 0; size < MaskHeader::kSize + kWidth * kHeight; ++size) {
    writer.Write(1, kWidth, kHeight, 1);
    writer.Truncate(size);
    MaskStream stream = Stream();
    EXPECT_NE(Attach(stream, 1), Status::kOk) << size;
    EXPECT_EQ(stream.counters().corrupt, 1U) << size;
  }
}

TEST_F(Masks, DamagedHeader_NeverGivesAMaskOfAnotherSize) {
  MaskWriter writer(Path());
  for (std::size_t offset = 0; offset < 36; ++offset) {
    for (const int value : {0x00, 0x01, 0x7F, 0x80, 0xFF}) {
      writer.Write(1, kWidth, kHeight, 1);
      writer.PutByte(offset, static_cast<std::uint8_t>(value));
      MaskStream stream = Stream();
      if (Attach(stream, 1) == Status::kOk) {
        EXPECT_EQ(frame_.mask.width_px, kWidth);
        EXPECT_EQ(frame_.mask.height_px, kHeight);
      } else {
        EXPECT_FALSE(frame_.mask.given());
      }
    }
  }
}

TEST_F(Masks, WriterThatComesLateAndComesBack_IsFound) {
  MaskStream stream = Stream();
  EXPECT_EQ(Attach(stream, 1), Status::kNotFound);
  {
    MaskWriter writer(Path());
    EXPECT_NE(Attach(stream, 1), Status::kOk) << "nothing written yet";
    writer.Write(1, kWidth, kHeight, 4);
    EXPECT_EQ(Attach(stream, 1), Status::kOk);
  }
  EXPECT_EQ(Attach(stream, 2), Status::kNotFound);
  MaskWriter again(Path());
  again.Write(3, kWidth, kHeight, 6);
  EXPECT_EQ(Attach(stream, 3), Status::kOk);
  EXPECT_TRUE(EveryPixelIs(6));
}

TEST_F(Masks, WriterAtWorkAllTheTime_NeverGivesAMixture) {
  constexpr int kMasks = 500;
  MaskWriter writer(Path());
  MaskStream stream = Stream();
  writer.Write(1, kWidth, kHeight, 0);
  ASSERT_EQ(Attach(stream, 1), Status::kOk);
  std::atomic<bool> stop = false;
  std::thread thread([&] {
    for (std::uint8_t i = 1; !stop; ++i) {
      writer.Write(1, kWidth, kHeight, i);
      // A whole mask: where both share a processor the reader gets its turn here.
      std::this_thread::yield();
    }
  });
  // However often the reader finds the writer at work: until it has seen so many masks.
  const auto deadline = std::chrono::steady_clock::now() + test::kPatience;
  int seen = 0;
  int last = 0;
  bool whole = true;
  while (seen < kMasks && whole && std::chrono::steady_clock::now() < deadline) {
    whole = Attach(stream, 1) == Status::kOk && EveryPixelIs(frame_.mask.row(0)[0]);
    if (whole && frame_.mask.row(0)[0] != last) {
      last = frame_.mask.row(0)[0];
      ++seen;
    }
    std::this_thread::yield();
  }
  stop = true;
  thread.join();
  EXPECT_TRUE(whole) << "a mask was there from the start, so one is always given";
  EXPECT_EQ(seen, kMasks);
}

TEST_F(Masks, Names_AreChecked) {
  EXPECT_TRUE(CheckMaskName("/masks").ok());
  EXPECT_TRUE(CheckMaskName("file:/tmp/masks").ok());
  for (const char* name : {"", "/", "masks", "/a/b", "file:", "shm:/x"}) {
    const hal::Fault fault = CheckMaskName(name);
    EXPECT_EQ(fault.status, Status::kInvalidUri) << name;
    EXPECT_NE(std::string(fault.message).find("docs/masks.md"), std::string::npos);
  }
}

}  // namespace
}  // namespace disflow::posix
