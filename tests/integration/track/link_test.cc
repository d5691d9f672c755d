// SPDX-License-Identifier: BSD-3-Clause
#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <limits>
#include <map>

#include "child_process.h"
#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/hal/mavlink/telemetry.h"
#include "disflow/posix/file_descriptor.h"
#include "estimate_csv.h"
#include "eventually.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

namespace mavlink = hal::mavlink;

/// A UDP socket on a free local port.
class Receiver {
 public:
  Receiver() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    if (::bind(socket_.get(), generic, sizeof(address)) != 0) throw std::runtime_error("bind");
    socklen_t size = sizeof(address);
    (void)::getsockname(socket_.get(), generic, &size);
    port_ = ntohs(address.sin_port);
  }

  [[nodiscard]] std::string port() const { return std::to_string(port_); }

  /// Calls use(frame) for every MAVLink frame that has arrived and that the session accepts.
  template <class Use>
  void Drain(Use&& use, mavlink::SigningSession* session = nullptr) {
    std::array<std::byte, 2048> buffer;
    for (;;) {
      socklen_t sender_size = sizeof(sender_);
      const ssize_t size = ::recvfrom(socket_.get(), buffer.data(), buffer.size(), MSG_DONTWAIT,
                                      reinterpret_cast<sockaddr*>(&sender_), &sender_size);
      if (size <= 0) return;
      decoder_.ForEachFrame(std::span(buffer).first(static_cast<std::size_t>(size)), session, use);
    }
  }
  /// To whoever sent last.
  template <class Message>
  void Send(const Message& message) {
    std::array<std::byte, mavlink::kMaxFrameSize> buffer;
    const auto size =
        mavlink::EncodeFrame(message, {.sequence = 0, .system_id = 9, .component_id = 1}, buffer);
    EXPECT_GT(::sendto(socket_.get(), buffer.data(), size.value, 0,
                       reinterpret_cast<const sockaddr*>(&sender_), sizeof(sender_)),
              0);
  }
  [[nodiscard]] const mavlink::DecoderCounters& counters() const { return decoder_.counters(); }

 private:
  posix::FileDescriptor socket_;
  std::uint16_t port_ = 0;
  sockaddr_in sender_{};
  mavlink::FrameDecoder decoder_;
};

class LinkTest : public ScratchFolderTest {};

TEST_F(LinkTest, QuestionAboutTheDistance_IsAnsweredOverUdp) {
  Receiver receiver;
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", "sim:bottle?frames=30000", "--rate", "realtime", "--link",
                      "udp://127.0.0.1:" + receiver.port()},
                     scratch());
  mavlink::DisflowQuery query;
  query.request = 4711;
  query.target_system = 190;
  query.target_component = 25;
  query.count = 3;
  // Towards the camera, step by step; and nowhere.
  query.z = {-0.2F, -0.3F, std::numeric_limits<float>::quiet_NaN()};
  mavlink::DisflowField field;
  bool answered = false;
  // Asked again with every frame.
  EXPECT_TRUE(Eventually([&] {
    bool may_ask = false;
    receiver.Drain([&](const mavlink::FrameView& frame) {
      may_ask = may_ask || frame.message_id == mavlink::Odometry::kId;
      if (frame.message_id != mavlink::DisflowField::kId) return;
      answered = mavlink::DecodePayload(frame, field) == Status::kOk;
    });
    if (may_ask && !answered) receiver.Send(query);
    return answered;
  }));
  track.Signal(SIGTERM);
  const Outcome outcome = track.Wait();
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  ASSERT_TRUE(answered);
  EXPECT_EQ(field.request, 4711U);
  EXPECT_EQ(field.count, 3);
  EXPECT_EQ(field.status, 0);
  EXPECT_GT(field.distance[0], 0.0F);
  EXPECT_NEAR(field.distance[1] - field.distance[0], 0.1F, 0.02F);
  EXPECT_NEAR(field.gradient_z[0], -1.0F, 0.1F);
  EXPECT_GT(field.variance[0], 0.0F);
  EXPECT_TRUE(std::isnan(field.distance[2]));
}

/// What is answered to a command, and how far off the object is then, by the messages of a run.
struct Obeyed {
  int result = -1;  ///< Of the last answer.
  float z_m = 0.0F;
  int reset_counter = -1;
};

/// Gives the command again with every frame until it is answered, and waits until `enough`.
template <class Enough>
Obeyed Command(Receiver& receiver, const mavlink::CommandLong& command, Enough&& enough) {
  Obeyed obeyed;
  EXPECT_TRUE(Eventually([&] {
    bool may_ask = false;
    receiver.Drain([&](const mavlink::FrameView& frame) {
      mavlink::CommandAck ack;
      mavlink::Odometry pose;
      if (mavlink::DecodePayload(frame, ack) == Status::kOk && ack.command == command.command) {
        EXPECT_EQ(ack.target_system, 9);
        obeyed.result = ack.result;
      } else if (frame.message_id == mavlink::Odometry::kId &&
                 mavlink::DecodePayload(frame, pose) == Status::kOk && pose.quality >= 0) {
        may_ask = true;
        obeyed.z_m = pose.x;  // forward
        obeyed.reset_counter = pose.reset_counter;
      }
    });
    if (may_ask && obeyed.result < 0) receiver.Send(command);
    return obeyed.result >= 0 && enough(obeyed);
  }));
  return obeyed;
}

mavlink::CommandLong TrackPoint(float u, float v) {
  mavlink::CommandLong command;
  command.param = {u, v, 0.03F, 0.0F, 0.0F, 0.0F, 0.0F};
  command.command = mavlink::CommandLong::kCameraTrackPoint;
  command.target_system = 190;
  command.target_component = 25;
  return command;
}

mavlink::CommandLong OfNoUse() {
  mavlink::CommandLong command = TrackPoint(0.5F, 0.5F);
  command.command = 400;
  return command;
}

constexpr const char* kTwoThings = "sim:box+bottle?motion=static&frames=30000&mask=none";
constexpr float kBottleU = 0.353F;  ///< Where the farther one is, shares of the image.
constexpr float kBottleV = 0.398F;
constexpr float kBetween_m = 0.75F;  ///< The nearer one is nearer, the farther one farther.

TEST_F(LinkTest, CommandToTrackAPoint_IsObeyedWhereTheLinkAllowsIt) {
  Receiver receiver;
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kTwoThings, "--rate", "realtime", "--link",
                      "udp://127.0.0.1:" + receiver.port() + "?choose=yes"},
                     scratch());
  const Obeyed before = Command(receiver, OfNoUse(), [](const Obeyed& o) { return o.z_m > 0.0F; });
  EXPECT_EQ(before.result, mavlink::CommandAck::kUnsupported);
  EXPECT_LT(before.z_m, kBetween_m);
  const Obeyed after = Command(receiver, TrackPoint(kBottleU, kBottleV),
                               [](const Obeyed& o) { return o.z_m > kBetween_m; });
  EXPECT_EQ(after.result, mavlink::CommandAck::kAccepted);
  EXPECT_NE(after.reset_counter, before.reset_counter);
  const Obeyed outside =
      Command(receiver, TrackPoint(1.5F, 0.5F), [](const Obeyed&) { return true; });
  EXPECT_EQ(outside.result, mavlink::CommandAck::kDenied);
  track.Signal(SIGTERM);
  EXPECT_EQ(track.Wait().exit_status, 0);
}

TEST_F(LinkTest, CommandToTrackAPoint_IsDeniedOnOtherLinks) {
  Receiver receiver;
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", kTwoThings, "--rate", "realtime", "--link",
                      "udp://127.0.0.1:" + receiver.port()},
                     scratch());
  const Obeyed obeyed = Command(receiver, TrackPoint(kBottleU, kBottleV),
                                [](const Obeyed& o) { return o.z_m > 0.0F; });
  EXPECT_EQ(obeyed.result, mavlink::CommandAck::kDenied);
  EXPECT_LT(obeyed.z_m, kBetween_m);
  EXPECT_EQ(obeyed.reset_counter, 0);
  track.Signal(SIGTERM);
  EXPECT_EQ(track.Wait().exit_status, 0);
}

TEST_F(LinkTest, LinkThatSendsLandingTargets_HasTheSamePlacesAndNoOdometry) {
  Receiver poses;
  Receiver autopilot;
  const Outcome outcome = RunTrack(
      {"--sensor", "sim:bottle?frames=20", "--link", "udp://127.0.0.1:" + poses.port(), "--link",
       "udp://127.0.0.1:" + autopilot.port() + "?send=landing_target", "--id", "2"},
      scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  std::map<std::uint64_t, mavlink::Odometry> measured;
  poses.Drain([&](const mavlink::FrameView& frame) {
    mavlink::Odometry odometry;
    if (mavlink::DecodePayload(frame, odometry) != Status::kOk || odometry.quality < 0) return;
    measured[odometry.time_usec] = odometry;
  });
  std::size_t targets = 0;
  autopilot.Drain([&](const mavlink::FrameView& frame) {
    EXPECT_NE(frame.message_id, mavlink::Odometry::kId);
    mavlink::LandingTarget target;
    if (mavlink::DecodePayload(frame, target) != Status::kOk) return;
    ++targets;
    ASSERT_TRUE(measured.contains(target.time_usec));
    // Nothing is said of where the camera sits: it looks ahead from the vehicle's origin.
    const mavlink::Odometry& odometry = measured[target.time_usec];
    EXPECT_NEAR(target.x, odometry.x, 1e-5F);
    EXPECT_NEAR(target.y, odometry.y, 1e-5F);
    EXPECT_NEAR(target.z, odometry.z, 1e-5F);
    EXPECT_NEAR(target.q[3], odometry.q[3], 1e-5F);
    EXPECT_EQ(target.target_num, 2);
    EXPECT_EQ(frame.header.component_id, 27);
  });
  EXPECT_GE(targets, 15U);
  EXPECT_EQ(targets, measured.size());
  EXPECT_EQ(autopilot.counters().bad_checksum, 0U);
}

TEST_F(LinkTest, UdpReceiver_GetsPoseAndStatusOfEveryFrameAndHeartbeats) {
  constexpr int kFrames = 45;  // 1.5 s
  Receiver receiver;
  const Outcome outcome =
      RunTrack({"--sensor", "sim:bottle?frames=" + std::to_string(kFrames), "--link",
                "udp://127.0.0.1:" + receiver.port(), "--id", "3", "--csv", Path("run.csv")},
               scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;

  std::map<std::uint32_t, int> messages;
  std::vector<mavlink::Odometry> poses;
  receiver.Drain([&](const mavlink::FrameView& frame) {
    ++messages[frame.message_id];
    EXPECT_EQ(frame.header.system_id, mavlink::TelemetryOptions{}.system_id);
    EXPECT_EQ(frame.header.component_id, mavlink::kFirstComponentId + 3);
    mavlink::Odometry pose;
    if (frame.message_id == mavlink::Odometry::kId &&
        mavlink::DecodePayload(frame, pose) == Status::kOk) {
      poses.push_back(pose);
    }
  });
  EXPECT_EQ(messages[mavlink::Odometry::kId], kFrames);
  EXPECT_EQ(messages[mavlink::DisflowStatus::kId], kFrames);
  EXPECT_GE(messages[mavlink::Heartbeat::kId], 2);
  EXPECT_EQ(receiver.counters().bad_checksum, 0U);
  EXPECT_EQ(receiver.counters().skipped_bytes, 0U);

  const apps::EstimateTable table = apps::LoadEstimates(Path("run.csv"), kFrames);
  ASSERT_EQ(poses.size(), table.rows.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto micros = static_cast<double>(poses[i].time_usec);
    EXPECT_NEAR(micros * 1e-6, table.rows[i].timestamp_s, 2e-6);
  }
}

TEST_F(LinkTest, SeveralObjects_AreAComponentEach) {
  Receiver receiver;
  const Outcome outcome =
      RunTrack({"--sensor", "sim:box+bottle?frames=10", "--object", "name=box,label=1", "--object",
                "name=bottle,label=2,index=7", "--link", "udp://127.0.0.1:" + receiver.port()},
               scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  std::map<std::pair<int, std::uint32_t>, int> messages;
  std::map<int, std::vector<int>> sequence_numbers;
  receiver.Drain([&](const mavlink::FrameView& frame) {
    const int object = frame.header.component_id - mavlink::kFirstComponentId;
    ++messages[{object, frame.message_id}];
    sequence_numbers[object].push_back(frame.header.sequence);
  });
  for (const int object : {0, 7}) {
    EXPECT_EQ((messages[{object, mavlink::Odometry::kId}]), 10);
    EXPECT_EQ((messages[{object, mavlink::DisflowStatus::kId}]), 10);
    EXPECT_GE((messages[{object, mavlink::Heartbeat::kId}]), 1);
    const std::vector<int>& numbers = sequence_numbers[object];
    for (std::size_t i = 0; i < numbers.size(); ++i)
      EXPECT_EQ(numbers[i], static_cast<int>(i)) << "each component counts for itself";
  }
  EXPECT_EQ(sequence_numbers.size(), 2U);
}

TEST_F(LinkTest, NobodyListens_TrackingGoesOn) {
  const Outcome outcome = RunTrack(
      {"--sensor", "sim:bottle?frames=5", "--link", "udp://127.0.0.1:9", "--csv", Path("run.csv")},
      scratch());
  EXPECT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_EQ(apps::LoadEstimates(Path("run.csv"), 5).rows.size(), 5U);
}

TEST_F(LinkTest, SerialDeviceVanishesWhileSending_TrackingGoesOnAndItIsSaidOnce) {
  constexpr int kFrames = 45;
  posix::FileDescriptor far_end(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  ASSERT_TRUE(far_end.is_open());
  ASSERT_EQ(::grantpt(far_end.get()), 0);
  ASSERT_EQ(::unlockpt(far_end.get()), 0);
  const std::string device = ::ptsname(far_end.get());
  ChildProcess track(DISFLOW_TRACK,
                     {"--sensor", "sim:bottle?frames=" + std::to_string(kFrames), "--rate",
                      "realtime", "--link", "serial://" + device, "--csv", Path("run.csv")},
                     scratch());
  std::array<std::byte, 512> bytes;
  ASSERT_GT(::read(far_end.get(), bytes.data(), bytes.size()), 0) << "something was sent";
  far_end.Reset();
  const Outcome outcome = track.Wait();
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  const std::size_t said = outcome.err.find("tracking goes on");
  EXPECT_NE(said, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("tracking goes on", said + 1), std::string::npos) << outcome.err;
  EXPECT_EQ(apps::LoadEstimates(Path("run.csv"), kFrames).rows.size(), std::size_t{kFrames});
}

TEST_F(LinkTest, SignedLink_SendsSignedMessagesOnlyAndNeverShowsItsKey) {
  const std::string hex(64, 'a');
  WriteFile(Path("link.key"), hex);
  std::filesystem::permissions(Path("link.key"), std::filesystem::perms{0600});
  Receiver receiver;
  const Arguments arguments{"--sensor", "sim:bottle?frames=5", "--link",
                            "udp://127.0.0.1:" + receiver.port() + "?key=" + Path("link.key")};
  const Outcome outcome = RunTrack(arguments, scratch());
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  int frames = 0;
  mavlink::SigningKey key;
  key.fill(std::byte{0xaa});
  mavlink::SigningSession session(key, 0);
  receiver.Drain(
      [&](const mavlink::FrameView& frame) {
        ++frames;
        EXPECT_TRUE(frame.is_signed);
      },
      &session);
  EXPECT_GE(frames, 10);
  EXPECT_EQ(receiver.counters().wrong_signature, 0U);
  EXPECT_EQ(receiver.counters().without_signature, 0U);
  for (const std::string& text : {outcome.out, outcome.err})
    EXPECT_EQ(text.find("aaaaaaaa"), std::string::npos) << text;
}

TEST_F(LinkTest, KeyThatOthersMayRead_IsSaidBeforeTheRun) {
  WriteFile(Path("link.key"), std::string(64, 'a'));
  std::filesystem::permissions(Path("link.key"), std::filesystem::perms{0644});
  const Outcome outcome = RunTrack(
      {"--sensor", "sim:bottle?frames=5", "--link", "udp://127.0.0.1:9?key=" + Path("link.key")},
      scratch());
  EXPECT_EQ(outcome.exit_status, 2) << outcome.err;
  EXPECT_NE(outcome.err.find("chmod 600"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find(Path("link.key")), std::string::npos) << outcome.err;
}

TEST_F(LinkTest, PortInUse_IsSaidBeforeTheRun) {
  const Receiver taken;
  WriteFile(Path("run.csv"), "earlier result\n");
  const Outcome outcome =
      RunTrack({"--sensor", "sim:bottle?frames=5", "--link",
                "udp://127.0.0.1:9?bind=" + taken.port(), "--csv", Path("run.csv")},
               scratch());
  EXPECT_EQ(outcome.exit_status, 4) << outcome.err;
  EXPECT_NE(outcome.err.find(taken.port()), std::string::npos) << outcome.err;
  EXPECT_EQ(ReadFile(Path("run.csv")), "earlier result\n");
}

}  // namespace
}  // namespace disflow::test
