// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "dds/dds_clock.h"
#include "dds/dds_inputs.h"
#include "disflow/hal/camera_pose_history.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000 * kMs;

/// What a node says on /tf.
class Tf {
 public:
  explicit Tf(posix::RosTransforms& transforms) : transforms_(transforms) {}

  void Say(std::string parent, std::string child, std::int64_t ros_ns, double x_m,
           bool fixed = false) {
    ros::TransformStamped message{};
    message.header.stamp = posix::RosTime(ros_ns);
    message.header.frame_id = parent.data();
    message.child_frame_id = child.data();
    message.transform.translation.x = x_m;
    message.transform.rotation.w = 1.0;
    transforms_.Add(TransformOf(message), fixed);
  }

 private:
  posix::RosTransforms& transforms_;
};

class DdsTransformsTest : public ::testing::Test {
 protected:
  posix::RosTransforms transforms_{"map", "camera"};
  Tf tf_{transforms_};
};

TEST_F(DdsTransformsTest, ChainThatMoves_GivesAPoseForEachOfItsMessages) {
  tf_.Say("base", "camera", 0, 0.5, /*fixed=*/true);
  tf_.Say("map", "odom", kStart_ns, 10.0);
  EXPECT_FALSE(transforms_.Camera()) << "does not lead to the camera";
  tf_.Say("odom", "base", kStart_ns + 5 * kMs, 2.0);
  const auto pose = transforms_.Camera();
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->ros_ns, kStart_ns + 5 * kMs);
  EXPECT_DOUBLE_EQ(pose->T_wc.translation().x(), 12.5);
  EXPECT_FALSE(transforms_.Camera()) << "nothing has come since";
  tf_.Say("elsewhere", "nowhere", kStart_ns + 10 * kMs, 1.0);
  EXPECT_FALSE(transforms_.Camera()) << "nothing of the chain has come since";
}

TEST_F(DdsTransformsTest, NamesOfMegabytes_AreLeftOut) {
  const std::string long_name(posix::RosTransforms::kMaxName + 1, 'a');
  tf_.Say("map", long_name, kStart_ns, 1.0);
  tf_.Say(long_name, "camera", kStart_ns, 1.0);
  EXPECT_FALSE(transforms_.Camera());
  const std::string longest_name(posix::RosTransforms::kMaxName, 'a');
  tf_.Say("map", longest_name, kStart_ns, 1.0);
  tf_.Say(longest_name, "camera", kStart_ns, 1.0);
  EXPECT_TRUE(transforms_.Camera());
}

TEST_F(DdsTransformsTest, FixedLinksAlone_AreNoMotion) {
  tf_.Say("map", "camera", 0, 1.0, /*fixed=*/true);
  EXPECT_FALSE(transforms_.Camera());
}

TEST_F(DdsTransformsTest, WrongStampOfASlowLink_DoesNotDateTheOthers) {
  tf_.Say("map", "odom", kStart_ns + 3'600'000 * kMs, 10.0);
  for (int i = 0; i < 50; ++i) {
    tf_.Say("odom", "camera", kStart_ns + i * 20 * kMs, 0.0);
    const auto pose = transforms_.Camera();
    ASSERT_TRUE(pose);
    if (i > 0) {
      EXPECT_EQ(pose->ros_ns, kStart_ns + i * 20 * kMs);
    }
  }
}

TEST_F(DdsTransformsTest, OneWrongStamp_CostsItsOwnPoseAlone) {
  for (const std::int64_t error_ns : {3'600'000 * kMs, 5'000 * kMs, -5'000 * kMs, -kStart_ns}) {
    hal::CameraPoseHistory history({});
    for (int i = 0; i < 100; ++i) {
      const std::int64_t now_ns = kStart_ns + i * 20 * kMs;
      tf_.Say("map", "camera", now_ns + (i == 50 ? error_ns : 0), i * 0.01);
      const auto pose = transforms_.Camera();
      ASSERT_TRUE(pose);
      (void)history.Add(pose->ros_ns, pose->T_wc, 0, now_ns);
      Transform<World, Camera> T_wc;
      if (i < 2) continue;
      ASSERT_EQ(history.At(now_ns + 10 * kMs, T_wc), Status::kOk) << error_ns << " " << i;
      EXPECT_NEAR(static_cast<double>(T_wc.translation().x()), i * 0.01 + 0.005, 1e-4)
          << error_ns << " " << i;
    }
    EXPECT_EQ(history.counters().wrong_stamp, 1U) << error_ns;
  }
}

/// Clocks of a system that somebody sets.
std::int64_t realtime_ns = kStart_ns;
std::int64_t monotonic_ns = 5'000 * kMs;
std::int64_t ReadFake(clockid_t clock) {
  return clock == CLOCK_REALTIME ? realtime_ns : monotonic_ns;
}

TEST(DdsClock, SystemsClockThatIsSet_IsFollowedForWhatOthersSayAlone) {
  for (const bool live : {true, false}) {
    realtime_ns = kStart_ns;
    monotonic_ns = 5'000 * kMs;
    DdsClock clock(live ? DdsClock::Stamps::kMonotonic : DdsClock::Stamps::kSequence, &ReadFake);
    const StampNs first_ns = live ? monotonic_ns : StampNs{0};
    const std::int64_t said_ns = clock.ToRos(first_ns);
    EXPECT_EQ(said_ns, kStart_ns);
    EXPECT_EQ(clock.FromRosOfOthers(realtime_ns), first_ns);
    monotonic_ns += 100 * kMs;
    for (const std::int64_t set_ns : {100'000 * kMs, -3'600'000 * kMs}) {
      realtime_ns = kStart_ns + 100 * kMs + set_ns;
      EXPECT_EQ(clock.FromRosOfOthers(realtime_ns), first_ns + 100 * kMs) << set_ns;
      EXPECT_EQ(clock.FromRos(said_ns), first_ns);
      EXPECT_EQ(clock.ToRos(first_ns), said_ns);
    }
  }
}

TEST(DdsClock, StampsThatAreRosTime_StayAsTheyAreWhateverTheSystemsClockSays) {
  DdsClock clock(DdsClock::Stamps::kRos, &ReadFake);
  EXPECT_TRUE(clock.known());
  for (const std::int64_t set_ns : {0 * kMs, 100'000 * kMs, -3'600'000 * kMs}) {
    realtime_ns = kStart_ns + set_ns;
    constexpr std::int64_t kStamp_ns = 1'234'567'891'234'567'891;
    EXPECT_EQ(clock.ToRos(kStamp_ns), kStamp_ns);
    EXPECT_EQ(clock.FromRos(kStamp_ns), kStamp_ns);
    EXPECT_EQ(clock.FromRosOfOthers(kStamp_ns), kStamp_ns);
  }
}

}  // namespace
}  // namespace disflow::apps
