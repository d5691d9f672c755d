// SPDX-License-Identifier: BSD-3-Clause
#include "links/link_stamps.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "message_line.h"

namespace disflow::apps {
namespace {

using Stamps = hal::LinkAddress::Stamps;
using hal::mavlink::TimeSync;
using hal::mavlink::TimeSyncMessage;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr ClockReading kNow{.monotonic_ns = 500 * kSecond_ns,
                            .epoch_ns = 1'700'000'000'000'000'000};
constexpr std::int64_t kEpoch_ns = kNow.epoch_ns - kNow.monotonic_ns;

hal::SensorInfo Camera() {
  hal::SensorInfo info;
  info.live = true;
  return info;
}
hal::SensorInfo RosCamera() {
  hal::SensorInfo info = Camera();
  info.epoch_stamps = true;
  return info;
}

/// An autopilot whose clock is 1000 s ahead.
class AutopilotClock {
 public:
  static constexpr std::int64_t kAhead_ns = 1000 * kSecond_ns;

  AutopilotClock() {
    TimeSyncMessage message;
    EXPECT_TRUE(sync_.Ask(kNow.monotonic_ns - 2, message));
    message.tc1 = kNow.monotonic_ns - 1 + kAhead_ns;
    std::vector<std::byte> bytes(hal::mavlink::kMaxFrameSize);
    const auto size = hal::mavlink::EncodeFrame(
        message, {.sequence = 0, .system_id = 1, .component_id = 1}, bytes);
    test::MessageLine line(sync_);
    line.Deliver(std::span<const std::byte>(bytes).first(size.value), kNow.monotonic_ns);
  }
  [[nodiscard]] const TimeSync& sync() const { return sync_; }

 private:
  TimeSync sync_;
};

TEST(LinkStamps, NothingSaid_StampsAreTheImages) {
  for (const hal::SensorInfo& sensor : {Camera(), RosCamera(), hal::SensorInfo{}}) {
    EXPECT_EQ(LinkStamps(Stamps::kCapture, sensor).Of(42, kNow, {}), 42);
  }
}

TEST(LinkStamps, OfACamera_AreMovedToTheWantedClock) {
  const AutopilotClock autopilot;
  const StampNs capture_ns = kNow.monotonic_ns - kSecond_ns;
  const auto of = [&](Stamps wanted) {
    return LinkStamps(wanted, Camera()).Of(capture_ns, kNow, autopilot.sync());
  };
  EXPECT_EQ(of(Stamps::kMonotonic), capture_ns);
  EXPECT_EQ(of(Stamps::kEpoch), capture_ns + kEpoch_ns);
  EXPECT_EQ(of(Stamps::kAutopilot), capture_ns + AutopilotClock::kAhead_ns);
}

TEST(LinkStamps, OfRos_AreOfTheEpochAlready) {
  const AutopilotClock autopilot;
  const StampNs capture_ns = kNow.epoch_ns - kSecond_ns;
  const auto of = [&](Stamps wanted) {
    return LinkStamps(wanted, RosCamera()).Of(capture_ns, kNow, autopilot.sync());
  };
  EXPECT_EQ(of(Stamps::kEpoch), capture_ns);
  EXPECT_EQ(of(Stamps::kMonotonic), capture_ns - kEpoch_ns);
  EXPECT_EQ(of(Stamps::kAutopilot), capture_ns - kEpoch_ns + AutopilotClock::kAhead_ns);
}

TEST(LinkStamps, OfARecording_AreAsIfCapturedNowAndNeverLater) {
  LinkStamps stamps(Stamps::kMonotonic, hal::SensorInfo{});
  ClockReading now = kNow;
  // The first frame took long to come, the others go on at their pace.
  stamps.Play(7 * kSecond_ns, now);
  EXPECT_EQ(stamps.Of(7 * kSecond_ns, now, {}), now.monotonic_ns);
  now.monotonic_ns += kSecond_ns - 1000;
  stamps.Play(8 * kSecond_ns, now);
  EXPECT_EQ(stamps.Of(8 * kSecond_ns, now, {}), now.monotonic_ns);
  now.monotonic_ns += kSecond_ns + 5000;
  stamps.Play(9 * kSecond_ns, now);
  EXPECT_EQ(stamps.Of(9 * kSecond_ns, now, {}), now.monotonic_ns - 5000);
}

TEST(LinkStamps, RecordingThatJumps_BeginsAnewThere) {
  for (const StampNs jump_ns : {StampNs{-1000 * kSecond_ns}, StampNs{1'700'000'000 * kSecond_ns}}) {
    LinkStamps stamps(Stamps::kMonotonic, hal::SensorInfo{});
    ClockReading now = kNow;
    stamps.Play(2000 * kSecond_ns, now);
    now.monotonic_ns += kSecond_ns;
    const StampNs beyond_ns = 2000 * kSecond_ns + jump_ns;
    stamps.Play(beyond_ns, now);
    EXPECT_EQ(stamps.Of(beyond_ns, now, {}), now.monotonic_ns);
    // And back, as after one wrong stamp.
    now.monotonic_ns += kSecond_ns;
    stamps.Play(2002 * kSecond_ns, now);
    EXPECT_EQ(stamps.Of(2002 * kSecond_ns, now, {}), now.monotonic_ns);
  }
}

TEST(LinkStamps, AutopilotNotHeard_ThereIsNoStamp) {
  const LinkStamps stamps(Stamps::kAutopilot, Camera());
  EXPECT_TRUE(stamps.wants_autopilot());
  EXPECT_EQ(stamps.Of(42, kNow, {}), std::nullopt);
  EXPECT_EQ(stamps.Now(kNow, {}), std::nullopt);
}

TEST(LinkStamps, Now_IsOnTheClockOfTheStamps) {
  const AutopilotClock autopilot;
  const auto now = [&](Stamps wanted, const hal::SensorInfo& sensor) {
    return LinkStamps(wanted, sensor).Now(kNow, autopilot.sync());
  };
  EXPECT_EQ(now(Stamps::kCapture, Camera()), kNow.monotonic_ns);
  EXPECT_EQ(now(Stamps::kCapture, RosCamera()), kNow.epoch_ns);
  EXPECT_EQ(now(Stamps::kMonotonic, RosCamera()), kNow.monotonic_ns);
  EXPECT_EQ(now(Stamps::kEpoch, Camera()), kNow.epoch_ns);
  EXPECT_EQ(now(Stamps::kAutopilot, Camera()), kNow.monotonic_ns + AutopilotClock::kAhead_ns);
  LinkStamps recording(Stamps::kCapture, hal::SensorInfo{});
  EXPECT_EQ(recording.Now(kNow, {}), std::nullopt);
  recording.Play(kSecond_ns, kNow);
  EXPECT_EQ(recording.Now(kNow, {}), kSecond_ns);
}

TEST(LinkStamps, AbsurdStamps_NeverOverflow) {
  for (const StampNs stamp_ns :
       {std::numeric_limits<StampNs>::min(), std::numeric_limits<StampNs>::max()}) {
    for (const hal::SensorInfo& sensor : {Camera(), RosCamera(), hal::SensorInfo{}}) {
      LinkStamps stamps(Stamps::kEpoch, sensor);
      stamps.Play(stamp_ns, kNow);
      stamps.Play(0, kNow);
      (void)stamps.Of(stamp_ns, kNow, {});
    }
  }
}

}  // namespace
}  // namespace disflow::apps
