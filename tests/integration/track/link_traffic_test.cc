// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "disflow/hal/camera_pose_history.h"
#include "disflow/hal/mavlink/messages.h"
#include "links/link_reader.h"
#include "links/telemetry_output.h"
#include "loopback_port.h"

namespace disflow::apps {
namespace {

namespace mavlink = hal::mavlink;
using test::LoopbackPort;
using Bytes = std::vector<std::byte>;

constexpr std::uint8_t kCarrier = 7;
constexpr std::int64_t kFrame_ns = 33'333'333;
constexpr StampNs kStart_ns = 1'000'000'000'000;

/// The carrier's ODOMETRY at a moment.
Bytes Pose(StampNs stamp_ns) {
  mavlink::Odometry odometry;
  odometry.time_usec = static_cast<std::uint64_t>(stamp_ns / 1000);
  odometry.x = static_cast<float>(stamp_ns - kStart_ns) * 1e-9F;
  odometry.q = {1.0F, 0.0F, 0.0F, 0.0F};
  odometry.frame_id = static_cast<std::uint8_t>(mavlink::MavFrame::kLocalFrd);
  odometry.child_frame_id = static_cast<std::uint8_t>(mavlink::MavFrame::kBodyFrd);
  odometry.quality = 90;
  std::array<std::byte, mavlink::kMaxFrameSize> buffer{};
  const auto size = mavlink::EncodeFrame(
      odometry, {.sequence = 0, .system_id = kCarrier, .component_id = 1}, buffer);
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size.value)};
}

/// What else a link carries: headers of messages that DisFlow does not know, with any payload.
class ForeignTraffic {
 public:
  Bytes Next() {
    Bytes bytes(30 + random_() % 251);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random_());
    bytes[0] = std::byte{0xFD};
    bytes[7] = std::byte{30};
    return bytes;
  }

 private:
  std::mt19937 random_;
};

Options WithLink(std::uint16_t peer, std::uint16_t own) {
  Options options;
  options.objects.emplace_back();
  options.links = {"udp://127.0.0.1:" + std::to_string(peer) + "?bind=" + std::to_string(own)};
  options.camera_pose.system_id = kCarrier;
  return options;
}

/// A program's links, and the other end of one of them.
class LinkTrafficTest : public ::testing::Test {
 protected:
  /// A frame's time, in which 50 poses per second and other datagrams come in; the poses last.
  void PassAFrame(int frame, int foreign) {
    constexpr std::int64_t kStep_ns = 20'000'000;
    now_ns_ = kStart_ns + frame * kFrame_ns;
    for (int i = 0; i < foreign; ++i) peer_.SendTo(own_, traffic_.Next());
    for (; posed_ns_ <= now_ns_; posed_ns_ += kStep_ns) peer_.SendTo(own_, Pose(posed_ns_));
  }
  [[nodiscard]] bool IsMatched() {
    telemetry_.Receive(now_ns_);
    Transform<World, Camera> T_wc;
    if (history_.At(now_ns_, T_wc) != Status::kOk) return false;
    return std::abs(T_wc.translation().x() - static_cast<float>(now_ns_ - kStart_ns) * 1e-9F) <
           1e-3F;
  }

  LoopbackPort peer_;
  std::uint16_t own_ = LoopbackPort().number();  // free again now
  Options options_ = WithLink(peer_.number(), own_);
  Console console_{false};
  hal::CameraPoseHistory history_{{}};
  TelemetryOutput telemetry_{options_, hal::SensorInfo{}, &history_, console_};
  ForeignTraffic traffic_;
  StampNs posed_ns_ = kStart_ns;
  std::int64_t now_ns_ = kStart_ns;
};

TEST_F(LinkTrafficTest, TwoThousandForeignDatagramsASecond_CostNoFrameItsPose) {
  constexpr int kFrames = 300;
  int matched = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    PassAFrame(frame, /*foreign=*/67);
    if (IsMatched()) ++matched;
  }
  // 99 %; by the first frame one pose has come, which is no motion yet.
  EXPECT_GE(matched, kFrames * 99 / 100);
  EXPECT_EQ(history_.counters().refused, 0U);
}

TEST_F(LinkTrafficTest, AllThatCameInDuringAPause_IsReadAtOnce) {
  for (int frame = 0; frame < 3; ++frame) PassAFrame(frame, /*foreign=*/67);
  EXPECT_TRUE(IsMatched());
}

/// A link on which bytes wait, in pieces as a driver hands them out; each piece is filled with its
/// number.
class WaitingLink final : public hal::ByteLink {
 public:
  WaitingLink(std::size_t pieces, std::size_t piece_bytes)
      : pieces_(pieces), piece_bytes_(piece_bytes) {}
  [[nodiscard]] std::size_t taken() const { return taken_; }

 private:
  hal::Fault DoOpen() noexcept override { return {}; }
  void DoClose() noexcept override {}
  hal::Fault DoSend(std::span<const std::byte>) noexcept override { return {}; }
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override {
    if (taken_ == pieces_) return {0};
    const auto piece = buffer.first(std::min(piece_bytes_, buffer.size()));
    std::fill(piece.begin(), piece.end(), static_cast<std::byte>(++taken_));
    return {piece.size()};
  }
  [[nodiscard]] const char* DoName() const noexcept override { return "waiting"; }
  [[nodiscard]] hal::LinkCounters DoCounters() const noexcept override { return {}; }

  std::size_t pieces_;
  std::size_t piece_bytes_;
  std::size_t taken_ = 0;
};

TEST(LinkReader, PiecesOfASerialLine_AreHandedOnWholeAndInOrder) {
  WaitingLink link(20, 1000);
  LinkReader reader;
  const auto bytes = reader.Read(link);
  ASSERT_EQ(bytes.size(), 20'000U);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    ASSERT_EQ(std::to_integer<std::size_t>(bytes[i]), i / 1000 + 1) << i;
  EXPECT_EQ(reader.dropped_bytes(), 0U);
  EXPECT_TRUE(reader.Read(link).empty());
}

TEST(LinkReader, MoreThanIsLookedAt_LosesTheOldest) {
  constexpr std::size_t kPieces = 200;
  WaitingLink link(kPieces, 1000);
  LinkReader reader;
  const auto bytes = reader.Read(link);
  ASSERT_EQ(bytes.size(), LinkReader::kKept_bytes);
  EXPECT_EQ(reader.dropped_bytes(), kPieces * 1000 - LinkReader::kKept_bytes);
  for (std::size_t back = 1; back <= bytes.size(); ++back) {
    ASSERT_EQ(std::to_integer<std::size_t>(bytes[bytes.size() - back]), kPieces - (back - 1) / 1000)
        << back;
  }
}

TEST(LinkReader, SenderFasterThanTheReader_DoesNotHoldIt) {
  WaitingLink link(1'000'000'000, 2000);
  LinkReader reader;
  (void)reader.Read(link);
  EXPECT_LE(link.taken() * 2000, LinkReader::kTaken_bytes + 2000);
}

}  // namespace
}  // namespace disflow::apps
