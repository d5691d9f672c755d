// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

#include "disflow/hal/depth_stream/crc32.h"
#include "disflow/hal/depth_stream/packet_decoder.h"

namespace disflow::hal::depth_stream {
namespace {

using Bytes = std::vector<std::byte>;

/// Decoded packets with payloads of their own.
struct Packet {
  PacketType type;
  std::uint32_t sequence;
  Bytes payload;
};

std::vector<Packet> Decode(PacketDecoder& decoder, std::span<const std::byte> bytes) {
  std::vector<Packet> packets;
  PacketView view;
  for (const std::byte byte : bytes) {
    if (decoder.Push(byte, view)) {
      packets.push_back(
          {view.type, view.sequence, Bytes(view.payload.begin(), view.payload.end())});
    }
  }
  return packets;
}

Bytes Encoded(std::span<const std::uint16_t> depths, std::uint32_t first = 0) {
  EncodedPacket buffer;
  const auto bytes = EncodePixels(9, first, depths, buffer);
  return {bytes.begin(), bytes.end()};
}

std::vector<std::uint16_t> Random(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint16_t> depths(count);
  for (std::uint16_t& depth : depths) depth = static_cast<std::uint16_t>(random());
  return depths;
}

TEST(Crc32, CheckValue_IsThatOfTheStandard) {
  constexpr std::string_view kText = "123456789";
  EXPECT_EQ(Crc32(std::as_bytes(std::span(kText))), 0xCBF43926U);
}

TEST(DepthPacket, EncodedPacket_HasZeroesOnlyAtItsEnds) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    auto depths = Random(kMaxPixelsPerPacket, seed);
    if (seed % 2 == 0) std::fill(depths.begin(), depths.end(), std::uint16_t{0});
    const Bytes bytes = Encoded(depths);
    EXPECT_LE(bytes.size(), kMaxEncodedSize);
    EXPECT_EQ(std::count(bytes.begin(), bytes.end(), std::byte{0}), 2);
    EXPECT_EQ(bytes.front(), std::byte{0});
    EXPECT_EQ(bytes.back(), std::byte{0});
  }
}

TEST(DepthPacket, Pixels_ComeBackAsTheyWere) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    auto depths = Random(1 + seed % kMaxPixelsPerPacket, seed);
    depths[0] = seed % 2 == 0 ? 0 : 65535;
    PacketDecoder decoder;
    const auto packets = Decode(decoder, Encoded(depths, 17));
    ASSERT_EQ(packets.size(), 1U);
    EXPECT_EQ(packets[0].type, PacketType::kPixels);
    EXPECT_EQ(packets[0].sequence, 9U);
    std::vector<std::uint16_t> image(17 + depths.size());
    std::size_t next = 17;
    ASSERT_TRUE(DecodePixels(packets[0].payload, image, next));
    EXPECT_EQ(next, image.size());
    EXPECT_TRUE(std::equal(depths.begin(), depths.end(), image.begin() + 17));
  }
}

TEST(DepthPacket, SmoothDepths_TakeOneByteEach) {
  std::vector<std::uint16_t> depths(kMaxPixelsPerPacket);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    depths[i] = static_cast<std::uint16_t>(7000 + 50 * (i % 2));
  }
  EXPECT_LT(Encoded(depths).size(), depths.size() + 25);
}

TEST(DepthPacket, Start_ComesBackAsItWas) {
  const FrameStart start{.stamp_ns = -1234567890123456789,
                         .width_px = 240,
                         .height_px = 65535,
                         .unit_m = 1e-4F,
                         .camera = {1.0F, 2.0F, 3.5F, -4.25F}};
  EncodedPacket buffer;
  PacketDecoder decoder;
  const auto packets = Decode(decoder, EncodeStart(0x12345678, start, buffer));
  ASSERT_EQ(packets.size(), 1U);
  EXPECT_EQ(packets[0].type, PacketType::kStart);
  EXPECT_EQ(packets[0].sequence, 0x12345678U);
  FrameStart read;
  ASSERT_TRUE(DecodeStart(packets[0].payload, read));
  EXPECT_EQ(read.stamp_ns, start.stamp_ns);
  EXPECT_EQ(read.width_px, start.width_px);
  EXPECT_EQ(read.height_px, start.height_px);
  EXPECT_EQ(read.unit_m, start.unit_m);
  EXPECT_EQ(read.camera.fx_px, start.camera.fx_px);
  EXPECT_EQ(read.camera.fy_px, start.camera.fy_px);
  EXPECT_EQ(read.camera.cx_px, start.camera.cx_px);
  EXPECT_EQ(read.camera.cy_px, start.camera.cy_px);
}

TEST(DepthPacket, Budgets_ComeBackAsTheyWere) {
  EncodedPacket buffer;
  PacketDecoder decoder;
  const auto packets =
      Decode(decoder, EncodeBudgets(1, {.frame_us = 0x89ABCDEF, .stage_us = 7}, buffer));
  ASSERT_EQ(packets.size(), 1U);
  TimeBudgets budgets;
  ASSERT_TRUE(DecodeBudgets(packets[0].payload, budgets));
  EXPECT_EQ(budgets.frame_us, 0x89ABCDEFU);
  EXPECT_EQ(budgets.stage_us, 7U);
}

TEST(DepthPacket, AnyFlippedByte_LosesThatPacketAlone) {
  const Bytes good = Encoded(Random(20, 1));
  const Bytes next = Encoded(Random(3, 2));
  PacketDecoder undamaged;
  const Bytes next_payload = Decode(undamaged, next).at(0).payload;
  for (std::size_t i = 1; i + 1 < good.size(); ++i) {  // inside of the delimiters
    Bytes stream = good;
    stream[i] ^= std::byte{0x41};
    stream.insert(stream.end(), next.begin(), next.end());
    PacketDecoder decoder;
    const auto packets = Decode(decoder, stream);
    ASSERT_EQ(packets.size(), 1U) << i;
    EXPECT_EQ(packets[0].payload, next_payload) << i;
    EXPECT_GE(decoder.counters().corrupt, 1U) << i;
  }
}

TEST(DepthPacket, LostByte_LosesThatPacketAlone) {
  const Bytes good = Encoded(Random(20, 1));
  const Bytes next = Encoded(Random(3, 2));
  for (std::size_t i = 1; i + 1 < good.size(); ++i) {
    Bytes stream = good;
    stream.erase(stream.begin() + static_cast<std::ptrdiff_t>(i));
    stream.insert(stream.end(), next.begin(), next.end());
    PacketDecoder decoder;
    EXPECT_EQ(Decode(decoder, stream).size(), 1U) << i;
    EXPECT_EQ(decoder.counters().corrupt, 1U) << i;
  }
}

TEST(DepthPacket, EndlessGarbage_IsCountedAndTheNextPacketIsRead) {
  std::mt19937 random(3);
  PacketDecoder decoder;
  Bytes garbage(100000);
  for (std::byte& byte : garbage) byte = static_cast<std::byte>(random());
  EXPECT_TRUE(Decode(decoder, garbage).empty());
  EXPECT_GT(decoder.counters().corrupt, 100U);
  EXPECT_EQ(Decode(decoder, Encoded(Random(5, 4))).size(), 1U);
}

TEST(DepthPacket, TooLong_IsRefusedAndTheNextPacketIsRead) {
  PacketDecoder decoder;
  EXPECT_TRUE(Decode(decoder, Bytes(10 * kMaxEncodedSize, std::byte{1})).empty());
  EXPECT_EQ(Decode(decoder, Encoded(Random(5, 4))).size(), 1U);
  EXPECT_EQ(decoder.counters().corrupt, 1U);
}

TEST(DepthPacket, PixelsThatCannotBe_AreRefusedWithinTheImage) {
  std::vector<std::uint16_t> image(4, 7);
  const auto refused = [&](const Bytes& payload, std::size_t next) {
    return !DecodePixels(payload, std::span(image).first(3), next) && image[3] == 7;
  };
  const auto bytes = [](std::initializer_list<int> values) {
    Bytes result;
    for (const int value : values) result.push_back(static_cast<std::byte>(value));
    return result;
  };
  EXPECT_TRUE(refused(bytes({0, 0, 0}), 0)) << "no index";
  EXPECT_TRUE(refused(bytes({1, 0, 0, 0, 2}), 0)) << "not the pixel that is due";
  EXPECT_TRUE(refused(bytes({0, 0, 0, 0, 2, 2, 2, 2}), 0)) << "beyond the image";
  EXPECT_TRUE(refused(bytes({0, 0, 0, 0, 1}), 0)) << "negative";
  EXPECT_TRUE(refused(bytes({0, 0, 0, 0, 0x80}), 0)) << "ends within a number";
  EXPECT_TRUE(refused(bytes({0, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0x01}), 0)) << "number too long";
  EXPECT_TRUE(refused(bytes({0, 0, 0, 0, 0xFE, 0xFF, 0x7F}), 0)) << "beyond 16 bits";
}

}  // namespace
}  // namespace disflow::hal::depth_stream
