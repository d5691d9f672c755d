// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_source.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

using Event = FrameSource::Event;

constexpr std::int64_t kFrame_ns = 33'000'000;

/// A clock on which sleeping takes no time.
class FakeClock final : public hal::Clock {
 public:
  std::int64_t now_ns = 1'000'000'000;

 private:
  std::int64_t DoNowNs() noexcept override { return now_ns; }
  void DoSleepUntilNs(std::int64_t deadline_ns) noexcept override {
    now_ns = std::max(now_ns, deadline_ns);
  }
};

/// Plays what the test says.
class FakeSensor final : public hal::DepthSensor {
 public:
  struct Turn {
    Status status = Status::kOk;
    StampNs stamp_ns = 0;
  };

  std::deque<Turn> turns;
  std::deque<Status> answers_to_open;  ///< Empty: it opens.
  bool live = false;
  bool epoch_stamps = false;
  int opened = 0;

 private:
  hal::Fault DoOpen() noexcept override {
    ++opened;
    Status status = Status::kOk;
    if (!answers_to_open.empty()) {
      status = answers_to_open.front();
      answers_to_open.pop_front();
    }
    return status == Status::kOk ? hal::Fault{} : hal::MakeFault(status, "cannot be opened");
  }
  hal::Fault DoNext(std::int64_t, DepthFrame& frame) noexcept override {
    if (turns.empty()) return hal::MakeFault(Status::kEndOfStream, "end");
    const Turn turn = turns.front();
    turns.pop_front();
    if (turn.status != Status::kOk) return hal::MakeFault(turn.status, "trouble");
    frame.stamp_ns = turn.stamp_ns;
    return {};
  }
  void DoClose() noexcept override {}
  hal::SensorInfo DoInfo() const noexcept override {
    hal::SensorInfo info;
    info.live = live;
    info.epoch_stamps = epoch_stamps;
    return info;
  }
  hal::SensorCounters DoCounters() const noexcept override { return {}; }
};

class FrameSourceTest : public testing::Test {
 protected:
  FrameSource Make(Rate rate, std::int64_t max_frames = 0) {
    return {sensor_, clock_, rate, max_frames, console_};
  }
  /// @return When each frame was given, until the end of the input.
  std::vector<std::int64_t> PlayAll(FrameSource source) {
    std::vector<std::int64_t> given_ns;
    DepthFrame frame;
    for (;;) {
      const Event event = source.Next(frame);
      if (event == Event::kEnd) return given_ns;
      if (event == Event::kFrame) given_ns.push_back(clock_.now_ns);
    }
  }

  FakeClock clock_;
  FakeSensor sensor_;
  Console console_{false};
};

TEST_F(FrameSourceTest, RateMax_NeverSleeps) {
  sensor_.turns = {{.stamp_ns = 0}, {.stamp_ns = kFrame_ns}, {.stamp_ns = 1'000 * kFrame_ns}};
  const std::int64_t begin_ns = clock_.now_ns;
  EXPECT_EQ(PlayAll(Make(Rate::kMax)), std::vector<std::int64_t>(3, begin_ns));
}

TEST_F(FrameSourceTest, RateRealtime_KeepsThePaceOfTheStamps) {
  sensor_.turns = {
      {.stamp_ns = 500}, {.stamp_ns = 500 + kFrame_ns}, {.stamp_ns = 500 + 9 * kFrame_ns}};
  const std::int64_t begin_ns = clock_.now_ns;
  EXPECT_EQ(PlayAll(Make(Rate::kRealtime)),
            (std::vector{begin_ns, begin_ns + kFrame_ns, begin_ns + 9 * kFrame_ns}));
}

TEST_F(FrameSourceTest, OneStampFarInTheFuture_HoldsUpNothing) {
  constexpr std::int64_t kCentury_ns = 3'155'760'000'000'000'000;
  sensor_.turns = {{.stamp_ns = 0},
                   {.stamp_ns = kCentury_ns},
                   {.stamp_ns = 2 * kFrame_ns},
                   {.stamp_ns = 3 * kFrame_ns}};
  const std::int64_t begin_ns = clock_.now_ns;
  EXPECT_EQ(PlayAll(Make(Rate::kRealtime)),
            (std::vector{begin_ns, begin_ns, begin_ns, begin_ns + kFrame_ns}));
}

TEST_F(FrameSourceTest, LiveSensor_IsNeverPaced) {
  sensor_.live = true;
  sensor_.turns = {{.stamp_ns = 0}, {.stamp_ns = 100 * kFrame_ns}};
  const std::int64_t begin_ns = clock_.now_ns;
  EXPECT_EQ(PlayAll(Make(Rate::kRealtime)), std::vector<std::int64_t>(2, begin_ns));
}

TEST_F(FrameSourceTest, UnreadableFrames_CountTowardsTheLimitAndKeepTheirReason) {
  sensor_.turns = {{}, {.status = Status::kCorrupt}, {.status = Status::kTruncated}, {}, {}};
  FrameSource source = Make(Rate::kMax, 4);
  DepthFrame frame;
  EXPECT_EQ(source.Next(frame), Event::kFrame);
  EXPECT_EQ(source.Next(frame), Event::kUnreadable);
  EXPECT_EQ(source.fault_status(), Status::kCorrupt);
  EXPECT_EQ(source.Next(frame), Event::kUnreadable);
  EXPECT_EQ(source.fault_status(), Status::kTruncated);
  EXPECT_EQ(source.Next(frame), Event::kFrame);
  EXPECT_EQ(source.Next(frame), Event::kEnd);
  EXPECT_EQ(source.unreadable(), 2);
  EXPECT_EQ(sensor_.turns.size(), 1U);
}

TEST_F(FrameSourceTest, Timeout_IsNoFrameAndDoesNotCount) {
  sensor_.turns = {{.status = Status::kTimeout}, {}};
  FrameSource source = Make(Rate::kMax, 1);
  DepthFrame frame;
  EXPECT_EQ(source.Next(frame), Event::kIdle);
  EXPECT_EQ(source.Next(frame), Event::kFrame);
  EXPECT_EQ(source.Next(frame), Event::kEnd);
}

TEST_F(FrameSourceTest, LiveSensorThatGoesAway_IsOpenedUntilItIsBack) {
  sensor_.live = true;
  sensor_.turns = {{.status = Status::kDeviceLost}, {.status = Status::kDeviceLost}, {}};
  sensor_.answers_to_open = {Status::kNotFound, Status::kOk};
  FrameSource source = Make(Rate::kMax);
  DepthFrame frame;
  const std::int64_t begin_ns = clock_.now_ns;
  EXPECT_EQ(source.Next(frame), Event::kIdle);
  EXPECT_EQ(source.Next(frame), Event::kIdle);
  EXPECT_EQ(source.Next(frame), Event::kFrame);
  EXPECT_EQ(sensor_.opened, 2);
  EXPECT_GT(clock_.now_ns, begin_ns) << "the device is not asked all the time";
}

TEST_F(FrameSourceTest, RecordingThatGoesAwayOrFails_EndsTheRunAsInputFailure) {
  for (const Status status : {Status::kDeviceLost, Status::kIoError, Status::kNotOpen}) {
    sensor_.turns = {{.status = status}};
    FrameSource source = Make(Rate::kMax);
    DepthFrame frame;
    try {
      (void)source.Next(frame);
      FAIL() << Describe(status);
    } catch (const Failure& failure) {
      EXPECT_EQ(failure.status(), kInputFailed);
      EXPECT_STREQ(failure.what(), "trouble");
    }
  }
  EXPECT_EQ(sensor_.opened, 0);
}

TEST_F(FrameSourceTest, AgeOfARecordedFrame_IsUnknown) {
  EXPECT_LT(Make(Rate::kMax).AgeNs(clock_.now_ns), 0);
  sensor_.live = true;
  EXPECT_EQ(Make(Rate::kMax).AgeNs(clock_.now_ns - 5), 5);
  // Of another clock.
  sensor_.epoch_stamps = true;
  EXPECT_LT(Make(Rate::kMax).AgeNs(clock_.now_ns - 5), 0);
}

}  // namespace
}  // namespace disflow::apps
