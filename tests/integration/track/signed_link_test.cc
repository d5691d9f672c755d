// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <optional>

#include "disflow/hal/camera_pose_history.h"
#include "disflow/posix/link.h"
#include "disflow/posix/signing_key_file.h"
#include "disflow/posix/signing_time_file.h"
#include "eventually.h"
#include "links/telemetry_output.h"
#include "loopback_port.h"
#include "program/exit_status.h"
#include "scratch_folder.h"
#include "signed_samples.h"

namespace disflow::apps {
namespace {

namespace mavlink = hal::mavlink;
using mavlink::testing::Bytes;
using mavlink::testing::Encoded;
using mavlink::testing::KeyNumber;
using test::Eventually;
using test::LoopbackPort;

constexpr std::uint8_t kCarrier = 7;

/// A program's links with a key, and an own link at the other end that has a session of its own.
class SignedLinkTest : public test::ScratchFolderTest {
 protected:
  SignedLinkTest() { WriteKey("a.key", KeyNumber(1)); }

  void WriteKey(const std::string& name, const mavlink::SigningKey& key) const {
    test::WriteFile(Path(name), {reinterpret_cast<const char*>(key.data()), key.size()});
    ASSERT_EQ(::chmod(Path(name).c_str(), 0600), 0);
  }
  void Start(const std::string& key_option, int links = 1) {
    options_ = {};
    options_.objects.emplace_back();
    options_.camera_pose.system_id = kCarrier;
    for (int i = 0; i < links; ++i) {
      options_.links.push_back("udp://127.0.0.1:" + std::to_string(peer_.number()) +
                               "?bind=" + std::to_string(own_[i]) + key_option);
    }
    telemetry_.emplace(options_, hal::SensorInfo{}, &history_, console_);
  }
  void StartWithKey(int links = 1) { Start("&key=" + Path("a.key"), links); }

  /// The carrier's next ODOMETRY.
  [[nodiscard]] Bytes Pose() {
    mavlink::Odometry odometry;
    odometry.time_usec = static_cast<std::uint64_t>(++poses_) * 20'000;
    odometry.q = {1.0F, 0.0F, 0.0F, 0.0F};
    odometry.frame_id = static_cast<std::uint8_t>(mavlink::MavFrame::kLocalFrd);
    odometry.quality = 90;
    return Encoded(odometry, {.sequence = 0, .system_id = kCarrier, .component_id = 1});
  }
  [[nodiscard]] Bytes SignedPose(mavlink::SigningSession& session) {
    return mavlink::testing::Signed(session, posix::SigningTimeNow(), Pose());
  }
  /// @return Poses that were taken of these bytes.
  std::uint32_t Taken(std::span<const std::byte> bytes, int link = 0) {
    const std::uint32_t before = history_.counters().poses;
    peer_.SendTo(own_[link], bytes);
    telemetry_->Receive(poses_ * 20'000'000);
    return history_.counters().poses - before;
  }
  /// The next HEARTBEAT as it is on the wire.
  [[nodiscard]] Bytes SentHeartbeat() {
    now_ns_ += 2'000'000'000;
    telemetry_->KeepAlive(now_ns_);
    return ReceivedHeartbeat();
  }
  /// Other messages are passed over.
  [[nodiscard]] Bytes ReceivedHeartbeat() {
    Bytes bytes;
    do {
      bytes.assign(2048, std::byte{0});
      bytes.resize(peer_.Receive(bytes, test::kPatience_ms));
    } while (bytes.size() > mavlink::kHeaderSize &&
             mavlink::MessageIdOf(bytes) != mavlink::Heartbeat::kId);
    return bytes;
  }
  [[nodiscard]] std::string Said() { return telemetry_->Summary().front(); }

  LoopbackPort peer_;
  std::uint16_t own_[2] = {LoopbackPort().number(), LoopbackPort().number()};  // free again now
  Options options_;
  Console console_{false};
  hal::CameraPoseHistory history_{{}};
  std::optional<TelemetryOutput> telemetry_;
  mavlink::SigningSession other_end_{KeyNumber(1), posix::SigningTimeNow()};
  mavlink::FrameDecoder decoder_;
  std::int64_t poses_ = 0;
  std::int64_t now_ns_ = 0;
};

TEST_F(SignedLinkTest, WhatIsSent_IsAcceptedByTheOtherEndAndByNoOtherKey) {
  StartWithKey();
  const Bytes heartbeat = SentHeartbeat();
  mavlink::SigningSession stranger(KeyNumber(2), posix::SigningTimeNow());
  EXPECT_EQ(mavlink::testing::Accepted(decoder_, stranger, heartbeat), 0U);
  EXPECT_EQ(decoder_.counters().wrong_signature, 1U);
  decoder_ = {};
  EXPECT_EQ(mavlink::testing::Accepted(decoder_, other_end_, heartbeat), 1U);
  EXPECT_EQ(mavlink::testing::Accepted(decoder_, other_end_, heartbeat), 0U);
}

TEST_F(SignedLinkTest, WhatTheOtherEndSigns_IsTaken) {
  StartWithKey();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(Taken(SignedPose(other_end_)), 1U);
  EXPECT_EQ(Said().find("received"), std::string::npos) << Said();
}

TEST_F(SignedLinkTest, UnsignedForgedAndReplayedMessages_AreLeftOutCountedAndReported) {
  StartWithKey();
  mavlink::SigningSession stranger(KeyNumber(2), posix::SigningTimeNow());
  EXPECT_EQ(Taken(Pose()), 0U);
  EXPECT_EQ(Taken(SignedPose(stranger)), 0U);
  EXPECT_EQ(Taken(SignedPose(stranger)), 0U);
  const Bytes genuine = SignedPose(other_end_);
  EXPECT_EQ(Taken(genuine), 1U);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Taken(genuine), 0U);
  EXPECT_NE(Said().find(", 1 received unsigned, 2 received with a wrong signature, 3 received "
                        "replayed"),
            std::string::npos)
      << Said();
}

TEST_F(SignedLinkTest, MessageOfOneLink_CannotBeReplayedOnAnotherOfTheSameKey) {
  StartWithKey(/*links=*/2);
  const Bytes genuine = SignedPose(other_end_);
  EXPECT_EQ(Taken(genuine, 0), 1U);
  EXPECT_EQ(Taken(genuine, 1), 0U);
  // The history would not have taken the same stamp twice either.
  EXPECT_NE(telemetry_->Summary().back().find("1 received replayed"), std::string::npos)
      << telemetry_->Summary().back();
}

TEST_F(SignedLinkTest, EchoOfWhatWasSent_IsLeftOut) {
  StartWithKey();
  (void)Taken(SentHeartbeat());
  EXPECT_NE(Said().find("1 received replayed"), std::string::npos) << Said();
}

TEST_F(SignedLinkTest, LinksWithTheSameKey_SignWithNumbersOfTheirOwn) {
  StartWithKey(/*links=*/2);
  const Bytes first = SentHeartbeat();
  const Bytes second = ReceivedHeartbeat();
  ASSERT_EQ(first.size(), second.size());
  const std::size_t link_at = first.size() - mavlink::kSignatureSize;
  EXPECT_EQ(first[link_at], std::byte{0});
  EXPECT_EQ(second[link_at], std::byte{1});
}

TEST_F(SignedLinkTest, WithoutAKey_SignedAndUnsignedMessagesAreTakenAndNothingIsSigned) {
  Start("");
  EXPECT_EQ(Taken(SignedPose(other_end_)), 1U);
  EXPECT_EQ(Taken(Pose()), 1U);
  EXPECT_EQ(SentHeartbeat()[2], std::byte{0});
}

TEST_F(SignedLinkTest, ClockThatWentBackOverARestart_StillSignsLaterThanBefore) {
  {
    // As a run left it whose clock was an hour ahead.
    posix::SigningTimeFile file;
    ASSERT_TRUE(file.Open(Path("a.key.time")).ok());
    ASSERT_TRUE(file.Save(posix::SigningTimeNow() + 60 * mavlink::kSigningMinute));
  }
  for (int run = 0; run < 3; ++run) {
    StartWithKey();
    const Bytes heartbeat = SentHeartbeat();
    telemetry_.reset();
    EXPECT_EQ(mavlink::testing::Accepted(decoder_, other_end_, heartbeat), 1U) << "run " << run;
    EXPECT_GE(other_end_.time(), posix::SigningTimeNow() + 59 * mavlink::kSigningMinute);
  }
}

TEST_F(SignedLinkTest, TimeThatCannotBeKept_IsNoReasonNotToSign) {
  std::filesystem::create_directory(Path("a.key.time"));
  StartWithKey();
  EXPECT_EQ(mavlink::testing::Accepted(decoder_, other_end_, SentHeartbeat()), 1U);
}

TEST_F(SignedLinkTest, KeyThatCannotBeUsed_IsWrongUsageThatNamesTheFile) {
  test::WriteFile(Path("short.key"), "k");
  ASSERT_EQ(::chmod(Path("short.key").c_str(), 0600), 0);
  for (const char* const name : {"short.key", "none.key"}) {
    try {
      Start("&key=" + Path(name));
      ADD_FAILURE() << name;
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.status(), kWrongUsage);
      EXPECT_NE(std::string(failure.what()).find(Path(name)), std::string::npos) << failure.what();
    }
  }
}

}  // namespace
}  // namespace disflow::apps
