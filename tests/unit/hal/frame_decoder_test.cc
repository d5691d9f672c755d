// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/frame_decoder.h"

#include <gtest/gtest.h>

#include "wire_samples.h"

namespace disflow::hal::mavlink::testing {
namespace {

[[nodiscard]] Bytes Signed(Bytes frame, std::uint8_t crc_extra) {
  frame[2] = std::byte{kFlagSigned};
  FixChecksum(frame, crc_extra);
  Append(frame, RandomBytes(kSignatureSize, 3));
  return frame;
}

TEST(FrameDecoder, StreamInPiecesOfAnySize_GivesTheSameFrames) {
  Bytes stream;
  Append(stream, Encoded(Filled<Odometry>()));
  Append(stream, Encoded(Filled<DisflowStatus>()));
  Append(stream, Encoded(Filled<Heartbeat>()));
  for (std::size_t step = 1; step <= kMaxFrameSize; ++step) {
    FrameDecoder decoder;
    const auto frames = DecodeAll(decoder, stream, step);
    ASSERT_EQ(frames.size(), 3U) << "step " << step;
    EXPECT_EQ(frames[0].view.message_id, Odometry::kId);
    EXPECT_EQ(frames[1].view.message_id, DisflowStatus::kId);
    EXPECT_EQ(frames[2].view.message_id, Heartbeat::kId);
    EXPECT_EQ(decoder.counters().skipped_bytes, 0U);
  }
}

TEST(FrameDecoder, StreamSplitAtAnyByte_LosesNothing) {
  const Bytes frame = Encoded(Filled<Odometry>());
  for (std::size_t split = 0; split <= frame.size(); ++split) {
    FrameDecoder decoder;
    const std::span<const std::byte> bytes(frame);
    std::size_t found = DecodeAll(decoder, bytes.first(split)).size();
    EXPECT_EQ(found, split == frame.size() ? 1U : 0U);
    found += DecodeAll(decoder, bytes.subspan(split)).size();
    EXPECT_EQ(found, 1U) << "split " << split;
  }
}

TEST(FrameDecoder, TruncatedFrame_YieldsNothing) {
  const Bytes frame = Encoded(Filled<DisflowStatus>());
  for (std::size_t size = 0; size < frame.size(); ++size) {
    FrameDecoder decoder;
    EXPECT_TRUE(DecodeAll(decoder, std::span(frame).first(size)).empty()) << "size " << size;
  }
}

TEST(FrameDecoder, AnyFlippedBit_IsDetected) {
  const Bytes frame = Encoded(Filled<DisflowStatus>());
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Bytes damaged = frame;
    damaged[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    FrameDecoder decoder;
    EXPECT_TRUE(DecodeAll(decoder, damaged).empty()) << "bit " << bit;
  }
}

TEST(FrameDecoder, DamagedPayload_IsCountedAsBadChecksum) {
  Bytes frame = Encoded(Filled<DisflowStatus>());
  frame[kHeaderSize] ^= std::byte{0x10};
  FrameDecoder decoder;
  EXPECT_TRUE(DecodeAll(decoder, frame).empty());
  EXPECT_EQ(decoder.counters().bad_checksum, 1U);
  EXPECT_EQ(decoder.counters().skipped_bytes, frame.size());
}

TEST(FrameDecoder, FrameAfterTruncatedFrame_IsNotLost) {
  const Bytes whole = Encoded(Filled<Odometry>());
  const Bytes next = Encoded(Filled<DisflowStatus>());
  for (std::size_t size = 1; size < whole.size(); ++size) {
    Bytes stream(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    Append(stream, next);
    // Bytes that let a frame begun by the cut one come to its end.
    Append(stream, Bytes(kMaxFrameSize, std::byte{0}));
    FrameDecoder decoder;
    const auto frames = DecodeAll(decoder, stream);
    ASSERT_EQ(frames.size(), 1U) << "cut at " << size;
    EXPECT_EQ(frames[0].view.message_id, DisflowStatus::kId);
  }
}

TEST(FrameDecoder, RandomGarbageBetweenFrames_CostsNoFrame) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    Bytes stream = RandomBytes(seed, seed);
    for (const int repeat : {1, 2, 3}) {
      Append(stream, Encoded(Filled<Heartbeat>(repeat)));
      Append(stream, RandomBytes(40, seed + static_cast<std::uint32_t>(repeat)));
    }
    Append(stream, Bytes(kMaxFrameSize, std::byte{0}));
    FrameDecoder decoder;
    const auto frames = DecodeAll(decoder, stream, 1 + seed % 50);
    ASSERT_EQ(frames.size(), 3U) << "seed " << seed;
    EXPECT_EQ(decoder.counters().frames, 3U);
  }
}

TEST(FrameDecoder, MagicBytesOnly_AreSkippedAsUnknown) {
  FrameDecoder decoder;
  EXPECT_TRUE(DecodeAll(decoder, Bytes(5000, std::byte{kMagic})).empty());
  EXPECT_GT(decoder.counters().unsupported_flags, 4000U);
}

TEST(FrameDecoder, RandomBytes_NeverStopTheDecoder) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    FrameDecoder decoder;
    Bytes noise = RandomBytes(4000, seed);
    // Many headers that look right at first.
    for (std::size_t i = 0; i + kHeaderSize < noise.size(); i += 37) {
      noise[i] = std::byte{kMagic};
      noise[i + 2] = std::byte{0};
      noise[i + 7] = noise[i + 8] = noise[i + 9] = std::byte{0};
    }
    std::span<const std::byte> rest(noise);
    FrameView frame;
    while (!rest.empty()) {
      const std::size_t taken = decoder.Feed(rest);
      ASSERT_GT(taken, 0U) << "the decoder is stuck";
      rest = rest.subspan(taken);
      while (decoder.Next(frame)) {
      }
    }
    EXPECT_GT(decoder.counters().bad_checksum, 0U);
  }
}

TEST(FrameDecoder, SignedFrame_IsReadAndItsSignatureSkipped) {
  Bytes stream = Signed(Encoded(Filled<Odometry>()), CrcExtra<Odometry>());
  Append(stream, Encoded(Filled<Heartbeat>()));
  FrameDecoder decoder;
  const auto frames = DecodeAll(decoder, stream);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_TRUE(frames[0].view.is_signed);
  EXPECT_FALSE(frames[1].view.is_signed);
  EXPECT_EQ(decoder.counters().skipped_bytes, 0U);
}

TEST(FrameDecoder, UnknownMessage_IsCountedAndSkipped) {
  Bytes stream = Encoded(Filled<Heartbeat>());
  stream[7] = std::byte{30};  // ATTITUDE
  Append(stream, Encoded(Filled<Heartbeat>()));
  FrameDecoder decoder;
  EXPECT_EQ(DecodeAll(decoder, stream).size(), 1U);
  EXPECT_EQ(decoder.counters().unknown_id, 1U);
  EXPECT_EQ(decoder.counters().bad_checksum, 0U);
}

TEST(FrameDecoder, UnknownIncompatibilityFlag_IsNotRead) {
  Bytes frame = Encoded(Filled<Heartbeat>());
  frame[2] = std::byte{0x02};
  FixChecksum(frame, CrcExtra<Heartbeat>());
  FrameDecoder decoder;
  EXPECT_TRUE(DecodeAll(decoder, frame).empty());
  EXPECT_EQ(decoder.counters().unsupported_flags, 1U);
}

TEST(FrameDecoder, LongestSignedFrame_Fits) {
  Bytes frame(kHeaderSize + kMaxPayloadSize + kChecksumSize, std::byte{9});
  const Bytes header = Encoded(Filled<Heartbeat>());
  std::copy_n(header.begin(), kHeaderSize, frame.begin());
  frame[1] = static_cast<std::byte>(kMaxPayloadSize);
  frame = Signed(frame, CrcExtra<Heartbeat>());
  ASSERT_EQ(frame.size(), kMaxFrameSize);
  FrameDecoder decoder;
  const auto frames = DecodeAll(decoder, frame);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].payload.size(), kMaxPayloadSize);
}

}  // namespace
}  // namespace disflow::hal::mavlink::testing
