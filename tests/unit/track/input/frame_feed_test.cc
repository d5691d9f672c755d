// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_feed.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <vector>

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

using Event = FrameSource::Event;

class StillClock final : public hal::Clock {
 private:
  std::int64_t DoNowNs() noexcept override { return 0; }
  void DoSleepUntilNs(std::int64_t) noexcept override {}
};

/// Frames of 4 x 2 pixels whose values are the frame's number, as fast as they are taken, but for
/// those that the test lets fail.
class NumberedSensor final : public hal::DepthSensor {
 public:
  std::uint32_t frames = 0;         ///< How many there are.
  std::uint32_t corrupt_every = 0;  ///< 0: none.
  Status end = Status::kEndOfStream;
  std::atomic<std::uint32_t> given = 0;

 private:
  hal::Fault DoOpen() noexcept override { return {}; }
  hal::Fault DoNext(std::int64_t, DepthFrame& frame) noexcept override {
    if (given == frames) return hal::MakeFault(end, "end");
    const std::uint32_t number = ++given;
    if (corrupt_every != 0 && number % corrupt_every == 0)
      return hal::MakeFault(Status::kCorrupt, "damaged");
    pixels_.fill(static_cast<std::uint16_t>(number));
    frame = {};
    frame.depth = {pixels_.data(), 4, 2, 8, DepthFormat::kUint16, 0.001F};
    frame.stamp_ns = number;
    return {};
  }
  void DoClose() noexcept override {}
  hal::SensorInfo DoInfo() const noexcept override {
    hal::SensorInfo info;
    info.width_px = 4;
    info.height_px = 2;
    info.live = true;
    return info;
  }
  hal::SensorCounters DoCounters() const noexcept override {
    hal::SensorCounters counters;
    counters.frames = given;
    return counters;
  }

  std::array<std::uint16_t, 8> pixels_{};
};

class FrameFeedTest : public testing::TestWithParam<bool> {
 protected:
  struct Played {
    std::vector<StampNs> stamps;
    int unreadable = 0;
    hal::SensorCounters counters;
  };
  /// Everything that the feed gives.
  Played Play() {
    FrameSource source(sensor_, clock_, Rate::kMax, 0, console_);
    FrameFeed feed(sensor_, source, GetParam(), realtime_, console_);
    Played played;
    DepthFrame frame;
    for (;;) {
      const FrameFeed::Turn turn = feed.Next(frame);
      played.counters = turn.counters;
      if (turn.event == Event::kEnd) return played;
      if (turn.event == Event::kUnreadable) {
        EXPECT_EQ(turn.fault, Status::kCorrupt);
        ++played.unreadable;
      }
      if (turn.event != Event::kFrame) continue;
      for (int v = 0; v < 2; ++v) {
        const auto* row = reinterpret_cast<const std::uint16_t*>(frame.depth.row(v));
        for (int u = 0; u < 4; ++u)
          EXPECT_EQ(row[u], static_cast<std::uint16_t>(frame.stamp_ns)) << "a mixture";
      }
      played.stamps.push_back(frame.stamp_ns);
    }
  }

  NumberedSensor sensor_;
  StillClock clock_;
  RealtimeOptions realtime_;
  Console console_{false};
};

TEST_P(FrameFeedTest, Frames_ComeWholeInOrderAndTheLastOneToo) {
  sensor_.frames = 2000;
  const Played played = Play();
  ASSERT_FALSE(played.stamps.empty());
  EXPECT_EQ(played.stamps.back(), 2000);
  for (std::size_t i = 1; i < played.stamps.size(); ++i)
    ASSERT_GT(played.stamps[i], played.stamps[i - 1]);
  // Straight from the source every frame comes; what a thread replaced by newer ones is counted.
  if (!GetParam()) {
    EXPECT_EQ(played.stamps.size(), 2000U);
  }
  EXPECT_EQ(played.stamps.size() + played.counters.dropped, 2000U);
  EXPECT_EQ(played.counters.skipped, played.counters.dropped);
}

TEST_P(FrameFeedTest, DamagedFrames_AreToldOrMakeWayForNewerOnes) {
  sensor_.frames = 90;
  sensor_.corrupt_every = 10;
  const Played played = Play();
  if (GetParam()) {
    EXPECT_LE(played.unreadable, 9);
    EXPECT_EQ(played.stamps.size() + played.counters.skipped, 81U);
  } else {
    EXPECT_EQ(played.unreadable, 9);
    EXPECT_EQ(played.stamps.size(), 81U);
  }
}

TEST_P(FrameFeedTest, SensorThatFailsForGood_IsTheTrackersFailureToo) {
  sensor_.frames = 20;
  sensor_.end = Status::kIoError;
  EXPECT_THROW((void)Play(), Failure);
}

TEST_P(FrameFeedTest, FeedThatIsGivenUp_EndsItsThread) {
  sensor_.frames = 1'000'000'000;
  FrameSource source(sensor_, clock_, Rate::kMax, 0, console_);
  {
    FrameFeed feed(sensor_, source, GetParam(), realtime_, console_);
    DepthFrame frame;
    EXPECT_EQ(feed.Next(frame).event, Event::kFrame);
  }
  const std::uint32_t given = sensor_.given;
  // A thread that went on would have asked for thousands by then.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(sensor_.given, given);
}

INSTANTIATE_TEST_SUITE_P(Feeds, FrameFeedTest, testing::Bool(), [](const auto& test) {
  return test.param ? std::string("threaded") : std::string("straight");
});

}  // namespace
}  // namespace disflow::apps
