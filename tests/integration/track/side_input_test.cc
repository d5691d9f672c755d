// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <vector>

#include "child_process.h"
#include "disflow/hal/camera_pose_history.h"
#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/hal/mavlink/messages.h"
#include "disflow/host/simulated_shapes.h"
#include "disflow/host/simulation.h"
#include "disflow/posix/mask_stream.h"
#include "loopback_port.h"
#include "scratch_folder.h"

namespace disflow::test {
namespace {

namespace mavlink = hal::mavlink;
using PoseD = Transform<World, Object, double>;
using Vec3d = Mat<double, 3>;

constexpr int kFrames = 60;
constexpr int kPosesPerFrame = 3;
constexpr std::uint8_t kCarrier = 7;

host::SimulationOptions MovingCamera(int per_frame) {
  host::SimulationOptions options;
  options.camera = host::CameraKind::kMoving;
  options.fps = 30.0 * per_frame;
  options.frames = kFrames * per_frame;
  return options;
}

/// Where the camera sits on its carrier.
Transform<hal::Body, Camera, double> Mounting() {
  return {Eigen::Quaternion<double, Eigen::DontAlign>(0.5, 0.5, 0.5, 0.5), Vec3d(0.1, -0.2, 0.05)};
}

/// The carrier's ODOMETRY at moments of which only every third is a frame's.
std::vector<std::vector<std::byte>> Messages() {
  const host::SimulationOptions options = MovingCamera(kPosesPerFrame);
  const host::Simulation simulation(options, host::MakeObjectMesh(options.object));
  std::vector<std::vector<std::byte>> messages;
  for (int i = 1; i < options.frames; ++i) {
    if (i % kPosesPerFrame == 0) continue;  // never at a frame's own moment
    const host::FrameTruth truth = simulation.TruthAt(i);
    const auto T_wb = truth.camera.pose * Mounting().Inverse();
    const auto q = T_wb.rotation_quaternion();
    mavlink::Odometry odometry;
    odometry.time_usec = static_cast<std::uint64_t>((truth.stamp_ns + 500) / 1000);
    odometry.x = static_cast<float>(T_wb.translation().x());
    odometry.y = static_cast<float>(T_wb.translation().y());
    odometry.z = static_cast<float>(T_wb.translation().z());
    odometry.q = {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
                  static_cast<float>(q.z())};
    odometry.frame_id = static_cast<std::uint8_t>(mavlink::MavFrame::kLocalNed);
    odometry.child_frame_id = static_cast<std::uint8_t>(mavlink::MavFrame::kBodyFrd);
    odometry.quality = 90;
    std::array<std::byte, mavlink::kMaxFrameSize> buffer{};
    const auto size = mavlink::EncodeFrame(
        odometry, {.sequence = 0, .system_id = kCarrier, .component_id = 1}, buffer);
    messages.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size.value));
  }
  return messages;
}

PoseD PoseOf(const mavlink::Odometry& odometry) {
  return {Eigen::Quaternion<double, Eigen::DontAlign>(
              static_cast<double>(odometry.q[0]), static_cast<double>(odometry.q[1]),
              static_cast<double>(odometry.q[2]), static_cast<double>(odometry.q[3])),
          Vec3d(static_cast<double>(odometry.x), static_cast<double>(odometry.y),
                static_cast<double>(odometry.z))};
}

class SideInputTest : public ScratchFolderTest {};

TEST_F(SideInputTest, OdometryOfTheCarrier_GivesTheObjectInTheWorld) {
  LoopbackPort carrier;
  const std::uint16_t own = LoopbackPort().number();  // free again now
  ChildProcess track(
      DISFLOW_TRACK,
      {"--sensor", "sim:box?camera=moving&frames=" + std::to_string(kFrames), "--rate", "realtime",
       "--link",
       "udp://127.0.0.1:" + std::to_string(carrier.number()) + "?bind=" + std::to_string(own),
       "--camera-pose", std::to_string(kCarrier), "--camera-world", "ned", "--camera-in-body",
       "0.1,-0.2,0.05,0.5,0.5,0.5,0.5"},
      scratch());
  std::array<std::byte, 2048> buffer{};
  std::vector<mavlink::Odometry> in_world;
  mavlink::FrameDecoder decoder;
  bool sent = false;
  for (std::size_t size = carrier.Receive(buffer, 20'000); size > 0;
       size = carrier.Receive(buffer, 1'500)) {
    // Somebody is there: say all, in the carrier's own time.
    if (!sent) {
      for (const auto& message : Messages()) carrier.SendTo(own, message);
    }
    sent = true;
    const auto bytes = std::span<const std::byte>(buffer).first(size);
    decoder.ForEachFrame(bytes, nullptr, [&in_world](const mavlink::FrameView& frame) {
      mavlink::Odometry odometry;
      if (mavlink::DecodePayload(frame, odometry) == Status::kOk &&
          odometry.frame_id == static_cast<std::uint8_t>(mavlink::MavFrame::kLocalNed)) {
        in_world.push_back(odometry);
      }
    });
  }
  const Outcome outcome = track.Wait();
  ASSERT_EQ(outcome.exit_status, 0) << outcome.err;
  EXPECT_GE(static_cast<int>(in_world.size()), kFrames / 2) << outcome.err;
  EXPECT_NE(outcome.err.find("camera poses:"), std::string::npos) << outcome.err;
  ASSERT_FALSE(in_world.empty());

  const host::SimulationOptions options = MovingCamera(1);
  const host::Simulation simulation(options, host::MakeObjectMesh(options.object));
  std::map<std::uint64_t, PoseD> truths;
  for (int i = 0; i < kFrames; ++i) {
    const host::FrameTruth truth = simulation.TruthAt(i);
    truths[static_cast<std::uint64_t>(truth.stamp_ns / 1000)] =
        truth.camera.pose * truth.object.pose;
  }
  const auto tie = PoseOf(in_world[0]).Inverse() * truths.at(in_world[0].time_usec);
  for (const mavlink::Odometry& odometry : in_world) {
    const PoseD truth = truths.at(odometry.time_usec);
    const PoseD said = PoseOf(odometry) * tie;
    EXPECT_LT((said.translation() - truth.translation()).norm(), 0.003);
    EXPECT_LT((said.Inverse() * truth).Log().tail<3>().norm(), 0.01);
  }
}

TEST_F(SideInputTest, CameraPoseWithoutSense_IsRefused) {
  const std::vector<Arguments> cases = {
      {"--camera-pose", "1"},
      {"--camera-pose", "190", "--link", "udp://127.0.0.1:9"},
      {"--camera-pose", "300", "--link", "udp://127.0.0.1:9"},
      {"--camera-pose", "1", "--link", "udp://127.0.0.1:9", "--camera-in-body", "0,0,0,1,1,0,0"},
      {"--camera-pose", "1", "--link", "udp://127.0.0.1:9", "--camera-in-body", "0,0,nan,1,0,0,0"},
      {"--camera-in-body", "0,0,0,1,1,0,0"},
      {"--link", "udp://127.0.0.1:9?send=follow_target"},
      {"--camera-pose", "1", "--link", "udp://127.0.0.1:9?send=follow_target"},
      {"--mask-stream", "masks"},
      {"--range", "2,1"},
      {"--roi", "0,0,10"}};
  for (Arguments arguments : cases) {
    arguments.insert(arguments.end(), {"--sensor", "sim:box?frames=3"});
    const Outcome outcome = RunTrack(arguments, scratch());
    EXPECT_EQ(outcome.exit_status, 2) << arguments[0] << " " << arguments[1];
    EXPECT_FALSE(outcome.err.empty());
  }
}

/// Writes one mask for all time: everything but the left half.
void WriteMask(const std::string& path, std::uint32_t width, std::uint32_t height,
               std::int64_t stamp_ns) {
  std::vector<std::uint8_t> bytes(posix::MaskHeader::kSize + std::size_t{width} * height, 255);
  std::fill(bytes.begin(), bytes.begin() + posix::MaskHeader::kSize, std::uint8_t{0});
  std::memcpy(bytes.data(), posix::MaskHeader::kMagic, 8);
  const std::uint64_t sequence = 2;
  std::memcpy(bytes.data() + 8, &sequence, 8);  // tests run on little-endian machines
  std::memcpy(bytes.data() + 16, &stamp_ns, 8);
  std::memcpy(bytes.data() + 24, &width, 4);
  std::memcpy(bytes.data() + 28, &height, 4);
  std::memcpy(bytes.data() + 32, &width, 4);
  WriteFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

TEST_F(SideInputTest, MasksFromElsewhere_AreUsedOrCountedWithTheReason) {
  host::SimulationOptions options;
  const host::Simulation simulation(options, host::MakeObjectMesh(options.object));
  const std::int64_t first_ns = simulation.TruthAt(0).stamp_ns;
  const auto run = [&](const std::string& name) {
    return RunTrack({"--sensor", "sim:box?mask=none&frames=9", "--mask-stream",
                     "file:" + Path(name), "--mask-age", "0.11", "--range", "0.2,1.2"},
                    scratch());
  };
  WriteMask(Path("fits"), 640, 360, first_ns);
  const Outcome fits = run("fits");
  EXPECT_EQ(fits.exit_status, 0) << fits.err;
  EXPECT_NE(fits.err.find("4 used, 0 missing, 5 late"), std::string::npos) << fits.err;
  WriteMask(Path("small"), 320, 180, first_ns);
  const Outcome small = run("small");
  EXPECT_EQ(small.exit_status, 0) << small.err;
  EXPECT_NE(small.err.find("9 of another size"), std::string::npos) << small.err;
  EXPECT_NE(small.err.find("640 x 360"), std::string::npos) << small.err;
  const Outcome none = run("nobody");
  EXPECT_EQ(none.exit_status, 0) << none.err;
  EXPECT_NE(none.err.find("9 missing"), std::string::npos) << none.err;
}

}  // namespace
}  // namespace disflow::test
