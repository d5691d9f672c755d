// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "wire_samples.h"

namespace disflow::hal::mavlink::testing {
namespace {

TEST(Crc, CheckValueOfTheCatalogue) {
  // CRC-16/MCRF4XX over "123456789" is 0x6F91 in the catalogue of parametrised CRC algorithms.
  Crc crc;
  EXPECT_EQ(crc.value(), 0xFFFF);
  crc.Add(std::string_view("123456789"));
  EXPECT_EQ(crc.value(), 0x6F91);
}

TEST(Frame, DefaultHeartbeat_HasTheBytesOfTheSpecification) {
  const Bytes bytes = Encoded(Heartbeat{}, {.sequence = 5, .system_id = 190, .component_id = 25});
  const std::array<int, 19> expected{0xFD, 9, 0, 0, 5,  190, 25, 0, 0, 0,  // header
                                     0,    0, 0, 0, 18, 8,   0,  3, 3};    // payload
  ASSERT_EQ(bytes.size(), expected.size() + kChecksumSize);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(std::to_integer<int>(bytes[i]), expected[i]) << "byte " << i;
  }
}

TEST(Frame, FullMessages_TakeTheirDocumentedSize) {
  EXPECT_EQ(Encoded(Filled<Odometry>()).size(), 245U);
  DisflowStatus status = Filled<DisflowStatus>();
  status.sensor_reconnects = 0xFFFF;
  EXPECT_EQ(Encoded(status).size(), 88U);
}

TEST(Frame, TrailingZeros_AreDropped) {
  Odometry odometry = Filled<Odometry>();
  odometry.reset_counter = 0;
  odometry.estimator_type = 0;
  odometry.quality = 0;
  EXPECT_EQ(Encoded(odometry).size(), 245U - 3U);
}

TEST(Frame, AllZeroPayload_KeepsItsFirstByte) {
  Heartbeat zero{};
  zero.type = zero.autopilot = zero.system_status = zero.mavlink_version = 0;
  const Bytes bytes = Encoded(zero);
  ASSERT_EQ(bytes.size(), kHeaderSize + 1 + kChecksumSize);
  EXPECT_EQ(std::to_integer<int>(bytes[1]), 1);
}

TEST(Frame, MessageId_IsThreeBytesLittleEndian) {
  const Bytes bytes = Encoded(Filled<DisflowStatus>());
  EXPECT_EQ(std::to_integer<int>(bytes[7]), 0x10);
  EXPECT_EQ(std::to_integer<int>(bytes[8]), 0x5F);
  EXPECT_EQ(std::to_integer<int>(bytes[9]), 0xD1);
}

TEST(Frame, TooSmallBuffer_IsRefusedAndUntouched) {
  Bytes bytes(kFrameSize<Odometry> - 1, std::byte{0xAA});
  const auto size = EncodeFrame(Odometry{}, kSender, bytes);
  EXPECT_EQ(size.status, Status::kCapacityExceeded);
  EXPECT_EQ(size.value, 0U);
  for (const std::byte byte : bytes) ASSERT_EQ(byte, std::byte{0xAA});
}

TEST(Frame, BufferOfExactlyTheFrame_IsEnough) {
  Bytes bytes(kFrameSize<Odometry>);
  EXPECT_TRUE(EncodeFrame(Filled<Odometry>(), kSender, bytes).ok());
}

/// Compares two messages by the bytes that they encode to, so that NaN equals NaN.
template <class Message>
void ExpectRoundTrip(const Message& message) {
  FrameDecoder decoder;
  const auto frames = DecodeAll(decoder, Encoded(message));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].view.message_id, Message::kId);
  EXPECT_EQ(frames[0].view.header.sequence, kSender.sequence);
  EXPECT_EQ(frames[0].view.header.system_id, kSender.system_id);
  EXPECT_EQ(frames[0].view.header.component_id, kSender.component_id);
  EXPECT_FALSE(frames[0].view.is_signed);
  Message decoded = Filled<Message>(77);
  ASSERT_EQ(DecodePayload(frames[0].view, decoded), Status::kOk);
  EXPECT_EQ(Encoded(decoded), Encoded(message));
}

template <class... Messages>
void ExpectRoundTripOfAll(MessageList<Messages...> /*list*/, int offset) {
  (ExpectRoundTrip(Filled<Messages>(offset)), ...);
}

TEST(Frame, RoundTrip_KeepsEveryFieldOfEveryMessage) {
  for (const int offset : {0, 1, 100, 100000}) ExpectRoundTripOfAll(KnownMessages{}, offset);
}

/// A message that nobody entered into KnownMessages.
struct LeftOut : Heartbeat {
  [[maybe_unused]] static constexpr std::uint32_t kId = 0xD15F1F;
};

template <class Message>
concept Encodes = requires(const Message& message, std::span<std::byte> out) {
  EncodeFrame(message, kSender, out);
};
template <class Message>
concept Decodes = requires(const FrameView& frame, Message& message) {
  DecodePayload(frame, message);
};
static_assert(Encodes<Heartbeat> && Decodes<Heartbeat>);
static_assert(!Encodes<LeftOut> && !Decodes<LeftOut>, "the decoder would take it for garbage");

TEST(Frame, RoundTrip_KeepsExtremes) {
  Odometry odometry = Filled<Odometry>();
  odometry.time_usec = std::numeric_limits<std::uint64_t>::max();
  odometry.x = -std::numeric_limits<float>::infinity();
  odometry.y = std::numeric_limits<float>::denorm_min();
  odometry.z = -0.0F;
  odometry.pose_covariance[0] = std::numeric_limits<float>::quiet_NaN();
  odometry.quality = Odometry::kQualityFailed;
  ExpectRoundTrip(odometry);
}

TEST(Frame, DecodedFields_AreThoseThatWereEncoded) {
  const Odometry sent = Filled<Odometry>();
  FrameDecoder decoder;
  const auto frames = DecodeAll(decoder, Encoded(sent));
  ASSERT_EQ(frames.size(), 1U);
  Odometry got;
  ASSERT_EQ(DecodePayload(frames[0].view, got), Status::kOk);
  EXPECT_EQ(got.time_usec, sent.time_usec);
  EXPECT_EQ(got.q, sent.q);
  EXPECT_EQ(got.yawspeed, sent.yawspeed);
  EXPECT_EQ(got.velocity_covariance, sent.velocity_covariance);
  EXPECT_EQ(got.quality, sent.quality);
}

TEST(Frame, DecodingAnotherMessage_IsRefusedAndChangesNothing) {
  FrameDecoder decoder;
  const auto frames = DecodeAll(decoder, Encoded(Filled<Heartbeat>()));
  ASSERT_EQ(frames.size(), 1U);
  DisflowStatus status = Filled<DisflowStatus>();
  EXPECT_EQ(DecodePayload(frames[0].view, status), Status::kUnsupported);
  EXPECT_EQ(Encoded(status), Encoded(Filled<DisflowStatus>()));
}

TEST(Frame, PayloadOfANewerDefinition_IsReadAsFarAsKnown) {
  // A sender with more extension fields sends a longer payload.
  Bytes payload(kMaxPayloadSize, std::byte{1});
  FrameView frame;
  frame.message_id = Heartbeat::kId;
  frame.payload = payload;
  Heartbeat heartbeat;
  ASSERT_EQ(DecodePayload(frame, heartbeat), Status::kOk);
  EXPECT_EQ(heartbeat.custom_mode, 0x01010101U);
  EXPECT_EQ(heartbeat.mavlink_version, 1);
}

}  // namespace
}  // namespace disflow::hal::mavlink::testing
