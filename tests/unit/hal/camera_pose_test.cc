// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "disflow/hal/camera_pose_history.h"
#include "disflow/hal/mavlink/camera_pose_input.h"
#include "message_line.h"

namespace disflow::hal {
namespace {

using BodyPose = Transform<World, Body, double>;
using Vec3d = Mat<double, 3>;

constexpr std::int64_t kMs = 1'000'000;
constexpr StampNs kStart = 86'400'000'000'000 * 300;  // after 300 days

/// A body on a screw motion: interpolation on SE(3) is exact.
BodyPose ScrewAt(double seconds) {
  Mat<double, 6> twist;
  twist << 0.3, -0.2, 0.1, 0.5, 1.0, -0.8;
  return BodyPose(Mat<double, 3, 3>(ExpSo3(Vec3d(0.1, 0.2, 0.3))), Vec3d(1.0, 2.0, 3.0)) *
         Transform<Body, Body, double>::Exp(seconds * twist);
}

CameraPoseHistory::Settings WithOffset() {
  CameraPoseHistory::Settings settings;
  settings.T_bc = {Mat3(ExpSo3(Vec3(0.0F, 0.5F, 0.0F))), Vec3(0.1F, 0.0F, -0.05F)};
  return settings;
}

/// Adds a pose as it comes in at its own moment.
Status Add(CameraPoseHistory& history, std::int64_t since_start_ns, double seconds,
           std::uint8_t reset_counter = 0) {
  const StampNs stamp_ns = kStart + since_start_ns;
  return history.Add(stamp_ns, ScrewAt(seconds), reset_counter, stamp_ns);
}

void Fill(CameraPoseHistory& history, int count, std::int64_t step_ns) {
  for (int i = 0; i < count; ++i) {
    EXPECT_EQ(Add(history, i * step_ns, static_cast<double>(i * step_ns) * 1e-9), Status::kOk);
  }
}

double Apart(const Transform<World, Camera>& a, const BodyPose& T_wb,
             const Transform<Body, Camera>& T_bc) {
  return (a.Cast<double>().Inverse() * (T_wb * T_bc.Cast<double>())).Log().norm();
}

TEST(CameraPoses, BetweenTwoPoses_TheScrewMotionIsExact) {
  CameraPoseHistory history(WithOffset());
  Fill(history, 20, 50 * kMs);
  Transform<World, Camera> T_wc;
  for (std::int64_t at = 0; at <= 950 * kMs; at += 7 * kMs) {
    ASSERT_EQ(history.At(kStart + at, T_wc), Status::kOk) << at;
    EXPECT_LT(Apart(T_wc, ScrewAt(static_cast<double>(at) * 1e-9), WithOffset().T_bc), 2e-6);
  }
  EXPECT_EQ(history.counters().continued, 0U);
}

TEST(CameraPoses, ALittleBeyondTheNewest_TheMotionGoesOn) {
  CameraPoseHistory history(WithOffset());
  Fill(history, 5, 20 * kMs);
  Transform<World, Camera> T_wc;
  ASSERT_EQ(history.At(kStart + 120 * kMs, T_wc), Status::kOk);
  EXPECT_LT(Apart(T_wc, ScrewAt(0.12), WithOffset().T_bc), 2e-6);
  EXPECT_EQ(history.counters().continued, 1U);
  EXPECT_EQ(history.At(kStart + 150 * kMs, T_wc), Status::kNotFound);
  EXPECT_EQ(history.counters().unmatched, 1U);
}

TEST(CameraPoses, GapBeforeTheFirstAndEmptyHistory_HaveNoPose) {
  CameraPoseHistory history(WithOffset());
  Transform<World, Camera> T_wc;
  EXPECT_EQ(history.At(kStart, T_wc), Status::kNotFound);
  EXPECT_EQ(Add(history, 0, 0.0), Status::kOk);
  EXPECT_EQ(history.At(kStart, T_wc), Status::kNotFound) << "one pose is no motion";
  EXPECT_EQ(Add(history, 400 * kMs, 0.4), Status::kOk);
  EXPECT_EQ(history.At(kStart + 200 * kMs, T_wc), Status::kNotFound) << "in a gap";
  EXPECT_EQ(history.At(kStart - 1, T_wc), Status::kNotFound);
  EXPECT_EQ(history.At(std::numeric_limits<std::int64_t>::min(), T_wc), Status::kNotFound);
  EXPECT_EQ(history.At(std::numeric_limits<std::int64_t>::max(), T_wc), Status::kNotFound);
}

TEST(CameraPoses, MoreThanTheCapacity_KeepsTheNewest) {
  CameraPoseHistory history(WithOffset());
  const int count = static_cast<int>(CameraPoseHistory::kCapacity) + 100;
  Fill(history, count, 5 * kMs);
  Transform<World, Camera> T_wc;
  EXPECT_EQ(history.At(kStart + 99 * 5 * kMs, T_wc), Status::kNotFound);
  for (int i = 100; i < count; ++i) {
    ASSERT_EQ(history.At(kStart + i * 5 * kMs, T_wc), Status::kOk) << i;
    EXPECT_LT(Apart(T_wc, ScrewAt(i * 0.005), WithOffset().T_bc), 3e-6);
  }
}

TEST(CameraPoses, JumpOfTheSender_IsNeverInterpolatedAcross) {
  CameraPoseHistory history(WithOffset());
  Fill(history, 3, 20 * kMs);
  EXPECT_EQ(Add(history, 60 * kMs, 5.0, 1), Status::kOk);
  Transform<World, Camera> T_wc;
  EXPECT_EQ(history.At(kStart + 50 * kMs, T_wc), Status::kNotFound);
  EXPECT_EQ(history.counters().jumps, 1U);
}

TEST(CameraPoses, WhatIsNoPoseOrNotNewer_IsRefused) {
  CameraPoseHistory history(WithOffset());
  Fill(history, 2, 20 * kMs);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(history.Add(kStart + 40 * kMs, BodyPose(ScrewAt(0.0).rotation(), Vec3d(nan, 0.0, 0.0)),
                        0, kStart),
            Status::kInvalidTransform);
  EXPECT_EQ(history.Add(kStart + 40 * kMs,
                        BodyPose(Mat<double, 3, 3>(2.0 * ScrewAt(0.0).rotation()), Vec3d::Zero()),
                        0, kStart),
            Status::kInvalidTransform);
  EXPECT_EQ(Add(history, 20 * kMs, 0.0), Status::kStampNotIncreasing);
  EXPECT_EQ(Add(history, 0, 0.0), Status::kStampNotIncreasing);
  EXPECT_EQ(history.counters().refused, 4U);
  EXPECT_EQ(history.counters().wrong_stamp, 2U);
  EXPECT_EQ(history.counters().poses, 2U);
}

TEST(CameraPoses, FasterThanTheMemoryHolds_StillReachBackTheTimePromised) {
  CameraPoseHistory history(WithOffset());
  constexpr int kPoses = 3000;
  Fill(history, kPoses, kMs);
  EXPECT_EQ(history.counters().poses, static_cast<std::uint32_t>(kPoses));
  Transform<World, Camera> T_wc;
  for (std::int64_t back = 0; back <= CameraPoseHistory::kMinSpan_ns; back += 3'333'333) {
    const std::int64_t at = (kPoses - 1) * kMs - back;
    ASSERT_EQ(history.At(kStart + at, T_wc), Status::kOk) << back;
    EXPECT_LT(Apart(T_wc, ScrewAt(static_cast<double>(at) * 1e-9), WithOffset().T_bc), 3e-6);
  }
  EXPECT_EQ(history.counters().continued, 0U);
}

TEST(CameraPoses, StampsFarFromNow_AreRefusedAndCounted) {
  CameraPoseHistory history(WithOffset());
  Fill(history, 2, 20 * kMs);
  constexpr StampNs kFar_ns = 3'600'000 * kMs;
  for (const StampNs stamp_ns :
       {StampNs{0}, kStart - kFar_ns, kStart + kFar_ns, std::numeric_limits<StampNs>::min(),
        std::numeric_limits<StampNs>::max()}) {
    // However many of them agree.
    for (int i = 0; i < 40; ++i) {
      const StampNs next_ns = stamp_ns > 0 ? stamp_ns - (40 - i) * kMs : stamp_ns + i * kMs;
      EXPECT_EQ(history.Add(next_ns, ScrewAt(0.0), 0, kStart + 20 * kMs),
                Status::kStampNotIncreasing);
    }
  }
  EXPECT_EQ(history.counters().wrong_stamp, 200U);
  EXPECT_EQ(Add(history, 40 * kMs, 0.04), Status::kOk);
  Transform<World, Camera> T_wc;
  ASSERT_EQ(history.At(kStart + 30 * kMs, T_wc), Status::kOk);
  EXPECT_LT(Apart(T_wc, ScrewAt(0.03), WithOffset().T_bc), 2e-6);
}

TEST(CameraPoses, MessagesThatComeTwiceOrBySlowerLinks_ChangeNothing) {
  CameraPoseHistory one(WithOffset());
  CameraPoseHistory two(WithOffset());
  for (int i = 0; i < 60; ++i) {
    (void)Add(one, i * 20 * kMs, i * 0.02);
    (void)Add(two, i * 20 * kMs, i * 0.02);
    (void)Add(two, i * 20 * kMs, i * 0.02);
    if (i >= 5) (void)Add(two, (i - 5) * 20 * kMs + 7 * kMs, (i - 5) * 0.02 + 0.007);
    Transform<World, Camera> a;
    Transform<World, Camera> b;
    ASSERT_EQ(one.At(kStart + i * 20 * kMs + 5 * kMs, a),
              two.At(kStart + i * 20 * kMs + 5 * kMs, b));
    EXPECT_TRUE(a.translation() == b.translation() && a.rotation() == b.rotation()) << i;
  }
  EXPECT_EQ(two.counters().poses, 60U);
}

/// One ODOMETRY as the carrier sends it.
std::vector<std::byte> Message(double seconds, std::uint8_t system, mavlink::MavFrame frame,
                               std::uint64_t time_usec, std::int8_t quality = 50) {
  const BodyPose pose = ScrewAt(seconds);
  mavlink::Odometry odometry;
  odometry.time_usec = time_usec;
  odometry.x = static_cast<float>(pose.translation().x());
  odometry.y = static_cast<float>(pose.translation().y());
  odometry.z = static_cast<float>(pose.translation().z());
  const auto q = pose.rotation_quaternion();
  odometry.q = {static_cast<float>(q.w()), static_cast<float>(q.x()), static_cast<float>(q.y()),
                static_cast<float>(q.z())};
  odometry.frame_id = static_cast<std::uint8_t>(frame);
  odometry.child_frame_id = 12;
  odometry.quality = quality;
  std::array<std::byte, mavlink::kMaxFrameSize> buffer{};
  const auto size = mavlink::EncodeFrame(
      odometry, {.sequence = 0, .system_id = system, .component_id = 1}, buffer);
  return {buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size.value)};
}

TEST(CameraPoseInput, OdometryOfTheCarrier_BecomesTheCamerasPose) {
  CameraPoseHistory history(WithOffset());
  mavlink::CameraPoseInput input({.system_id = 1}, history);
  test::MessageLine line(input);
  for (int i = 0; i < 10; ++i) {
    const auto bytes = Message(i * 0.02, 1, mavlink::MavFrame::kLocalFrd,
                               1'000'000 + static_cast<std::uint64_t>(i) * 20'000);
    // In pieces, as a serial line delivers them.
    line.Deliver(std::span(bytes).first(40), 0);
    line.Deliver(std::span(bytes).subspan(40), 0);
  }
  Transform<World, Camera> T_wc;
  ASSERT_EQ(history.At(1'000 * kMs + 70 * kMs, T_wc), Status::kOk);
  EXPECT_LT(Apart(T_wc, ScrewAt(0.07), WithOffset().T_bc), 1e-5);
}

TEST(CameraPoseInput, OthersOdometry_IsCountedAndLeftOut) {
  CameraPoseHistory history(WithOffset());
  mavlink::CameraPoseInput input({.system_id = 1}, history);
  test::MessageLine line(input);
  line.Deliver(Message(0.0, 2, mavlink::MavFrame::kLocalFrd, 1), 0);
  line.Deliver(Message(0.0, 1, mavlink::MavFrame::kLocalEnu, 2), 0);
  line.Deliver(Message(0.0, 1, mavlink::MavFrame::kLocalFrd, 3, -1), 0);
  EXPECT_EQ(input.counters().other_system, 1U);
  EXPECT_EQ(input.counters().other_frame, 1U);
  EXPECT_EQ(input.counters().failed, 1U);
  EXPECT_EQ(input.refused_frame(), 4);
  EXPECT_EQ(history.counters().poses, 0U);
}

TEST(CameraPoseInput, SendersOwnClock_IsLearntFromTheQuickestMessages) {
  CameraPoseHistory history(WithOffset());
  mavlink::CameraPoseInput input({.system_id = 1, .own_clock = true}, history);
  test::MessageLine line(input);
  constexpr std::int64_t kOffset_ns = 5'000'000 * kMs;
  for (int i = 0; i < 50; ++i) {
    const std::int64_t latency_ns = (2 + (i * 7) % 11) * kMs;
    const auto bytes =
        Message(i * 0.02, 1, mavlink::MavFrame::kLocalFrd, static_cast<std::uint64_t>(i) * 20'000);
    line.Deliver(bytes, i * 20 * kMs + kOffset_ns + latency_ns);
  }
  Transform<World, Camera> T_wc;
  ASSERT_EQ(history.At(kOffset_ns + 900 * kMs + 2 * kMs, T_wc), Status::kOk);
  EXPECT_LT(Apart(T_wc, ScrewAt(0.9), WithOffset().T_bc), 1e-3);
}

TEST(CameraPoseInput, StampsAtTheEndOfTime_DoNoHarm) {
  CameraPoseHistory history(WithOffset());
  mavlink::CameraPoseInput input({.system_id = 1, .own_clock = true}, history);
  test::MessageLine line(input);
  mavlink::CameraPoseInput same({.system_id = 1}, history);
  test::MessageLine same_line(same);
  for (const std::uint64_t stamp :
       {std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max(), std::uint64_t{1} << 63U}) {
    line.Deliver(Message(0.0, 1, mavlink::MavFrame::kLocalFrd, stamp), 5);
    same_line.Deliver(Message(0.0, 1, mavlink::MavFrame::kLocalFrd, stamp), 5);
  }
  // One comes to lie at the moment of arrival; one is older, the others are far away.
  EXPECT_EQ(history.counters().poses, 1U);
  EXPECT_EQ(history.counters().wrong_stamp, 4U);
  // One pose is no motion.
  Transform<World, Camera> T_wc;
  for (const StampNs at : {StampNs{5}, StampNs{1'000'000}, std::numeric_limits<StampNs>::max()})
    EXPECT_EQ(history.At(at, T_wc), Status::kNotFound) << at;
  EXPECT_EQ(T_wc.translation(), Vec3(Vec3::Zero()));
}

}  // namespace
}  // namespace disflow::hal
