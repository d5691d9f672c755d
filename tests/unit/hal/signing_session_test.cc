// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/signing_session.h"

#include <gtest/gtest.h>

#include "hex_bytes.h"
#include "signed_samples.h"

namespace disflow::hal::mavlink::testing {
namespace {

using hal::testing::BytesOf;
using hal::testing::HexOf;

/// Made by node-mavlink 2.1.0 and by Python's hashlib: link 5, 2026-01-02 03:04:05.678 UTC.
constexpr const char* kUnsignedAnswer = "fd09000000be19000000ccddeeff1208000403dec6";
constexpr const char* kSignedAnswer =
    "fd09010000be19000000ccddeeff1208000403393e05f82d0f1b951f5f8f7241cf7e";

FrameHeader From(int system_id, int component_id = 1) {
  return {.sequence = 0,
          .system_id = static_cast<std::uint8_t>(system_id),
          .component_id = static_cast<std::uint8_t>(component_id)};
}

class SigningSessionTest : public ::testing::Test {
 protected:
  [[nodiscard]] bool Accepts(const Bytes& frame) {
    return Accepted(decoder_, session_, frame) == 1;
  }
  [[nodiscard]] const DecoderCounters& counters() const { return decoder_.counters(); }

  FrameDecoder decoder_;
  SigningSession session_{kKey, kNow};
  const Bytes heartbeat_ = Encoded(Filled<Heartbeat>());
};

TEST(SigningTime, UnixTime_IsCountedFrom2015InTensOfMicroseconds) {
  EXPECT_EQ(SigningTimeOf(1'767'323'045'678'000'000), kNow);
  EXPECT_EQ(SigningTimeOf(1'420'070'400'000'010'000), 1U);
  EXPECT_EQ(SigningTimeOf(1'420'070'400'000'000'000 - 1), 0U);
  EXPECT_EQ(SigningTimeOf(-5), 0U);
  EXPECT_EQ(SigningTimeOf(std::numeric_limits<std::int64_t>::max()), kMaxSigningTime);
}

TEST_F(SigningSessionTest, KnownAnswer_IsSignedByteForByte) {
  EXPECT_EQ(HexOf(Signed(kNow, BytesOf(kUnsignedAnswer), 5)), kSignedAnswer);
}

TEST_F(SigningSessionTest, KnownAnswer_IsAcceptedOnce) {
  EXPECT_TRUE(Accepts(BytesOf(kSignedAnswer)));
  EXPECT_FALSE(Accepts(BytesOf(kSignedAnswer)));
  EXPECT_EQ(counters().frames, 1U);
  EXPECT_EQ(counters().replayed, 1U);
}

TEST_F(SigningSessionTest, UnsignedFrame_IsRefusedAndCounted) {
  EXPECT_FALSE(Accepts(heartbeat_));
  EXPECT_EQ(counters().without_signature, 1U);
  EXPECT_EQ(counters().frames, 0U);
  EXPECT_EQ(counters().skipped_bytes, heartbeat_.size());
}

TEST_F(SigningSessionTest, FrameOfAnotherKey_IsRefusedAndMovesNothing) {
  SigningSession other(KeyNumber(4), kNow);
  EXPECT_FALSE(Accepts(Signed(other, kNow + 1000, heartbeat_)));
  EXPECT_EQ(counters().wrong_signature, 1U);
  EXPECT_EQ(session_.time(), kNow);
  EXPECT_TRUE(Accepts(Signed(kNow, heartbeat_))) << "the forged time must not count";
}

TEST_F(SigningSessionTest, AnyFlippedBit_IsRefused) {
  const Bytes frame = Signed(kNow, heartbeat_);
  for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
    Bytes damaged = frame;
    damaged[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    FrameDecoder decoder;
    EXPECT_EQ(Accepted(decoder, session_, damaged), 0U) << "bit " << bit;
  }
  EXPECT_TRUE(Accepts(frame));
}

TEST_F(SigningSessionTest, TimeThatStandsStillOrRunsBackwards_IsRefusedAsReplayed) {
  EXPECT_TRUE(Accepts(Signed(kNow + 10, heartbeat_)));
  EXPECT_FALSE(Accepts(Signed(kNow + 10, Encoded(Filled<Heartbeat>(9)))));
  EXPECT_FALSE(Accepts(Signed(kNow + 9, heartbeat_)));
  EXPECT_EQ(counters().replayed, 2U);
  EXPECT_TRUE(Accepts(Signed(kNow + 11, heartbeat_)));
  EXPECT_FALSE(Accepts(Signed(kNow + 11, heartbeat_))) << "the newest counts, not the first";
}

TEST_F(SigningSessionTest, SystemComponentAndLink_AreAStreamEach) {
  EXPECT_TRUE(Accepts(Signed(kNow + 10, Encoded(Filled<Heartbeat>(), From(1, 1)), 1)));
  EXPECT_TRUE(Accepts(Signed(kNow + 9, Encoded(Filled<Heartbeat>(), From(2, 1)), 1)));
  EXPECT_TRUE(Accepts(Signed(kNow + 8, Encoded(Filled<Heartbeat>(), From(1, 2)), 1)));
  EXPECT_TRUE(Accepts(Signed(kNow + 7, Encoded(Filled<Heartbeat>(), From(1, 1)), 2)));
  EXPECT_EQ(counters().replayed, 0U);
}

TEST_F(SigningSessionTest, FrameFromAMinuteAgo_IsTheOldestThatIsAccepted) {
  EXPECT_FALSE(Accepts(Signed(kNow - kSigningMinute - 1, heartbeat_)));
  EXPECT_EQ(counters().outdated, 1U);
  EXPECT_TRUE(Accepts(Signed(kNow - kSigningMinute, heartbeat_)));
}

TEST_F(SigningSessionTest, FrameOfAKnownStreamHeldBackForMoreThanAMinute_IsRefused) {
  EXPECT_TRUE(Accepts(Signed(kNow, heartbeat_)));
  const Bytes held_back = Signed(kNow + 1, heartbeat_);
  session_.AdvanceTo(kNow + kSigningMinute + 2);
  EXPECT_FALSE(Accepts(held_back));
  EXPECT_EQ(counters().outdated, 1U);
}

TEST_F(SigningSessionTest, LaterTimeOfAPeer_IsTakenOver) {
  EXPECT_TRUE(Accepts(Signed(kNow + 500, heartbeat_)));
  EXPECT_EQ(session_.time(), kNow + 500);
  EXPECT_FALSE(Signed(session_, 1, heartbeat_).empty());
  EXPECT_EQ(session_.time(), kNow + 501) << "what is signed next is later";
}

TEST_F(SigningSessionTest, EarlierClock_ChangesNothing) {
  session_.AdvanceTo(kNow - 1);
  EXPECT_EQ(session_.time(), kNow);
  session_.AdvanceTo(kNow + 1);
  EXPECT_EQ(session_.time(), kNow + 1);
}

TEST_F(SigningSessionTest, FullTableOfStreams_RefusesNewOnesAndKeepsTheOld) {
  for (int i = 0; i < SigningSession::kMaxStreams; ++i) {
    ASSERT_TRUE(Accepts(Signed(kNow, Encoded(Filled<Heartbeat>(), From(1 + i)))));
  }
  EXPECT_FALSE(Accepts(Signed(kNow, Encoded(Filled<Heartbeat>(), From(200)))));
  EXPECT_EQ(counters().streams_refused, 1U);
  EXPECT_FALSE(Accepts(Signed(kNow, Encoded(Filled<Heartbeat>(), From(1)))));
  EXPECT_EQ(counters().replayed, 1U) << "a full table must still know its streams";
  EXPECT_TRUE(Accepts(Signed(kNow + 1, Encoded(Filled<Heartbeat>(), From(1)))));
}

TEST_F(SigningSessionTest, EchoOfAnOwnFrame_IsRefused) {
  SigningSession session(kKey, kNow, kSender.system_id);
  EXPECT_EQ(Accepted(decoder_, session, Signed(session, kNow, heartbeat_)), 0U);
  EXPECT_EQ(counters().replayed, 1U);
  EXPECT_EQ(Accepted(decoder_, session, Signed(kNow, Encoded(Filled<Heartbeat>(), From(1)))), 1U);
}

TEST_F(SigningSessionTest, LastTime_IsTheEndOfSigning) {
  session_.AdvanceTo(kMaxSigningTime + 5);
  EXPECT_EQ(session_.time(), kMaxSigningTime);
  Bytes out(kMaxFrameSize);
  EXPECT_EQ(session_.Sign(heartbeat_, 0, out).status, Status::kCapacityExceeded);
}

TEST_F(SigningSessionTest, WhatIsNoUnsignedFrame_IsNotSigned) {
  Bytes out(kMaxFrameSize);
  EXPECT_EQ(session_.Sign({}, 0, out).status, Status::kUnsupported);
  EXPECT_EQ(session_.Sign(Signed(kNow, heartbeat_), 0, out).status, Status::kUnsupported);
  EXPECT_EQ(session_.Sign(std::span(heartbeat_).first(20), 0, out).status, Status::kUnsupported);
  Bytes unknown = heartbeat_;
  unknown[7] = std::byte{30};
  EXPECT_EQ(session_.Sign(unknown, 0, out).status, Status::kUnsupported);
  out.resize(heartbeat_.size() + kSignatureSize - 1);
  EXPECT_EQ(session_.Sign(heartbeat_, 0, out).status, Status::kCapacityExceeded);
  EXPECT_EQ(session_.time(), kNow) << "no time is spent on what is not signed";
}

TEST_F(SigningSessionTest, FrameCutOffBeforeItsSignature_CostsNoneThatFollows) {
  const Bytes cut = Signed(kNow, Encoded(Filled<Odometry>(), From(3)));
  const Bytes next = Signed(kNow, heartbeat_);
  for (std::size_t missing = 1; missing <= kSignatureSize; ++missing) {
    FrameDecoder decoder;
    SigningSession session(kKey, kNow);
    Bytes stream(cut.begin(), cut.end() - static_cast<std::ptrdiff_t>(missing));
    Append(stream, next);
    Append(stream, Bytes(kMaxFrameSize, std::byte{0}));
    EXPECT_EQ(Accepted(decoder, session, stream), 1U) << missing << " bytes missing";
  }
}

TEST_F(SigningSessionTest, LongestFrame_IsSignedAndAccepted) {
  Bytes longest = Encoded(Filled<Odometry>());
  const Bytes frame = Signed(kNow, longest);
  EXPECT_EQ(frame.size(), longest.size() + kSignatureSize);
  EXPECT_TRUE(Accepts(frame));
}

}  // namespace
}  // namespace disflow::hal::mavlink::testing
