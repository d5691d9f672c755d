// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "signed_samples.h"

namespace disflow::hal::mavlink::testing {
namespace {

#ifdef DISFLOW_SANITIZED
constexpr std::size_t kEach = 25'000;  // ten times as slow
#else
constexpr std::size_t kEach = 250'000;
#endif

/// The receiver knows one sender, whose last frame was signed at kNow.
class ForgeryTest : public ::testing::Test {
 protected:
  ForgeryTest() { EXPECT_EQ(Accepted(decoder_, receiver_, genuine_), 1U); }
  /// What an attacker can change freely; the checksum is no secret.
  [[nodiscard]] Bytes Altered() {
    Bytes frame = Signed(sender_, 0, Encoded(Filled<Heartbeat>(static_cast<int>(random_() % 100))));
    const Bytes before = frame;
    const std::size_t from = kHeaderSize + (random_() % 2 == 0 ? 0 : 12);
    const unsigned changes = 1 + random_() % 4;
    for (unsigned i = 0; i < changes; ++i) {
      const std::size_t at = from + random_() % (frame.size() - from);
      frame[at] ^= static_cast<std::byte>(1 + random_() % 255);
    }
    FixChecksum(frame, CrcExtra<Heartbeat>());
    if (frame == before) frame.back() ^= std::byte{1};
    return frame;
  }
  /// A whole frame with a later time and a guessed signature.
  [[nodiscard]] Bytes Guessed() {
    Bytes frame = genuine_;
    for (std::size_t i = frame.size() - kSignatureSize + 4; i < frame.size(); ++i) {
      frame[i] = static_cast<std::byte>(random_());
    }
    return frame;
  }
  [[nodiscard]] Bytes OfAnotherKey() {
    return Signed(stranger_, 0, Encoded(Filled<Heartbeat>(static_cast<int>(random_() % 100))));
  }

  std::mt19937 random_{1};
  SigningSession sender_{kKey, kNow};
  SigningSession stranger_{KeyNumber(77), kNow};
  SigningSession receiver_{kKey, kNow};
  FrameDecoder decoder_;
  const Bytes genuine_ = Signed(sender_, 0, Encoded(Filled<Heartbeat>()));
};

TEST_F(ForgeryTest, OfAMillionForgedAlteredOrReplayedFrames_NoneIsAccepted) {
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < kEach; ++i) {
    accepted += Accepted(decoder_, receiver_, Altered());
    accepted += Accepted(decoder_, receiver_, Guessed());
    accepted += Accepted(decoder_, receiver_, OfAnotherKey());
    accepted += Accepted(decoder_, receiver_, genuine_);
  }
  EXPECT_EQ(accepted, 0U);
  const DecoderCounters& counters = decoder_.counters();
  // Bytes of a damaged frame may hold one byte that looks like the begin of another.
  EXPECT_GE(counters.wrong_signature, 2 * kEach) << "the test must get past the checksum";
  EXPECT_GE(counters.replayed, kEach * 9 / 10);
  // All that came in has moved nothing: the sender goes on.
  decoder_ = {};
  EXPECT_EQ(Accepted(decoder_, receiver_, Signed(sender_, 0, Encoded(Filled<Heartbeat>()))), 1U);
}

TEST_F(ForgeryTest, EveryFlippedBitOfEveryMessage_IsRefused) {
  const auto check = [&](const auto& message, std::uint8_t crc_extra) {
    const Bytes frame = Signed(sender_, 0, Encoded(message));
    for (std::size_t bit = 0; bit < 8 * frame.size(); ++bit) {
      for (const bool has_right_checksum : {false, true}) {
        Bytes damaged = frame;
        damaged[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
        // Not of a changed length, which says where the checksum is.
        if (has_right_checksum && bit / 8 != 1) FixChecksum(damaged, crc_extra);
        if (damaged == frame) continue;
        FrameDecoder decoder;
        ASSERT_EQ(Accepted(decoder, receiver_, damaged), 0U) << "bit " << bit;
      }
    }
    FrameDecoder decoder;
    EXPECT_EQ(Accepted(decoder, receiver_, frame), 1U);
  };
  check(Filled<Heartbeat>(), CrcExtra<Heartbeat>());
  check(Filled<Odometry>(), CrcExtra<Odometry>());
  check(Filled<DisflowStatus>(), CrcExtra<DisflowStatus>());
  check(Filled<DisflowReady>(), CrcExtra<DisflowReady>());
  check(Filled<DisflowTiming>(), CrcExtra<DisflowTiming>());
  check(Filled<DisflowQuery>(), CrcExtra<DisflowQuery>());
  check(Filled<DisflowField>(), CrcExtra<DisflowField>());
}

TEST_F(ForgeryTest, EveryFrameOfARecordedSession_IsRefusedWhenItComesAgain) {
  Bytes recorded;
  std::size_t accepted = 0;
  for (int i = 0; i < 5000; ++i) {
    const Bytes frame =
        Signed(sender_, 0, Encoded(Filled<Odometry>(i)), static_cast<std::uint8_t>(i % 3));
    accepted += Accepted(decoder_, receiver_, frame);
    Append(recorded, frame);
  }
  ASSERT_EQ(accepted, 5000U);
  EXPECT_EQ(Accepted(decoder_, receiver_, recorded), 0U);
}

}  // namespace
}  // namespace disflow::hal::mavlink::testing
