// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/depth_stream/stream_sensor.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "disflow/hal/mavlink/frame_decoder.h"

namespace disflow::hal::depth_stream {
namespace {

using mavlink::DisflowReady;

/// A line that holds what was put into it and remembers what was sent.
class FakeLine final : public ByteLink {
 public:
  void Arrive(std::span<const std::byte> bytes) {
    incoming_.insert(incoming_.end(), bytes.begin(), bytes.end());
  }
  /// The DISFLOW_READY messages sent since the last call.
  std::vector<DisflowReady> TakeReady() {
    std::vector<DisflowReady> messages;
    std::span<const std::byte> bytes(sent_);
    mavlink::FrameView view;
    while (!bytes.empty()) {
      bytes = bytes.subspan(decoder_.Feed(bytes));
      while (decoder_.Next(view)) {
        DisflowReady ready;
        if (mavlink::DecodePayload(view, ready) == Status::kOk) messages.push_back(ready);
      }
    }
    sent_.clear();
    return messages;
  }

 private:
  Fault DoOpen() noexcept override { return {}; }
  void DoClose() noexcept override {}
  Fault DoSend(std::span<const std::byte> message) noexcept override {
    sent_.insert(sent_.end(), message.begin(), message.end());
    return {};
  }
  Expected<std::size_t> DoReceive(std::span<std::byte> buffer) noexcept override {
    std::size_t size = 0;
    for (; size < buffer.size() && !incoming_.empty(); ++size) {
      buffer[size] = incoming_.front();
      incoming_.pop_front();
    }
    return {size};
  }
  [[nodiscard]] const char* DoName() const noexcept override { return "fake"; }
  [[nodiscard]] LinkCounters DoCounters() const noexcept override { return {}; }

  std::deque<std::byte> incoming_;
  std::vector<std::byte> sent_;
  mavlink::FrameDecoder decoder_;
};

/// Moves on a microsecond at every look.
class FakeClock final : public Clock {
 private:
  std::int64_t DoNowNs() noexcept override { return now_ns_ += 1000; }
  void DoSleepUntilNs(std::int64_t deadline_ns) noexcept override { now_ns_ = deadline_ns; }
  std::int64_t now_ns_ = 0;
};

class StreamSensorTest : public ::testing::Test {
 protected:
  static constexpr std::int64_t kPatience_ns = 1'000'000;
  static constexpr std::uint16_t kWidth = 20;
  static constexpr std::uint16_t kHeight = 10;

  static FrameStart Start(std::uint16_t width = kWidth, std::uint16_t height = kHeight) {
    return {.stamp_ns = 5000,
            .width_px = width,
            .height_px = height,
            .unit_m = 1e-4F,
            .camera = {100.0F, 101.0F, 10.0F, 5.0F}};
  }
  std::vector<std::vector<std::byte>> Packets(std::uint32_t sequence,
                                              const FrameStart& start = Start()) {
    std::vector<std::vector<std::byte>> packets;
    const auto add = [&](std::span<const std::byte> bytes) {
      packets.emplace_back(bytes.begin(), bytes.end());
    };
    EncodedPacket buffer;
    add(EncodeStart(sequence, start, buffer));
    const std::size_t count = std::size_t{start.width_px} * start.height_px;
    for (std::size_t first = 0; first < count; first += kMaxPixelsPerPacket) {
      std::vector<std::uint16_t> depths;
      for (std::size_t i = first; i < std::min(count, first + kMaxPixelsPerPacket); ++i) {
        depths.push_back(Depth(i));
      }
      add(EncodePixels(sequence, static_cast<std::uint32_t>(first), depths, buffer));
    }
    add(EncodeEnd(sequence, buffer));
    return packets;
  }
  static std::uint16_t Depth(std::size_t index) { return static_cast<std::uint16_t>(index * 37); }
  void Send(const std::vector<std::vector<std::byte>>& packets) {
    for (const auto& packet : packets) line_.Arrive(packet);
  }
  Status Next() { return sensor_.Next(kPatience_ns, frame_).status; }
  DisflowReady LastReady() {
    (void)Next();  // begins to wait
    const auto messages = line_.TakeReady();
    return messages.empty() ? DisflowReady{} : messages.back();
  }

  FakeLine line_;
  FakeClock clock_;
  std::vector<std::uint16_t> image_ = std::vector<std::uint16_t>(kWidth * kHeight);
  TimeBudgets budgets_;
  StreamSensor sensor_{line_, clock_, image_, budgets_};
  DepthFrame frame_;
};

TEST_F(StreamSensorTest, WholeFrame_ArrivesAsItWasSent) {
  Send(Packets(7));
  ASSERT_EQ(Next(), Status::kOk);
  EXPECT_EQ(frame_.stamp_ns, 5000);
  EXPECT_EQ(frame_.depth.width_px, kWidth);
  EXPECT_EQ(frame_.depth.height_px, kHeight);
  EXPECT_EQ(frame_.depth.unit_m, 1e-4F);
  EXPECT_EQ(frame_.camera.fy_px, 101.0F);
  EXPECT_EQ(CheckFrame(frame_, 64, 64), Status::kOk);
  for (std::size_t i = 0; i < image_.size(); ++i) EXPECT_EQ(image_[i], Depth(i));
  EXPECT_EQ(sensor_.counters().frames, 1U);
}

TEST_F(StreamSensorTest, Waiting_SaysReadyWithTheLastFramesNumber) {
  EXPECT_EQ(LastReady().sequence, 0U);
  Send(Packets(7));
  ASSERT_EQ(Next(), Status::kOk);
  const DisflowReady ready = LastReady();
  EXPECT_EQ(ready.sequence, 7U);
  EXPECT_EQ(ready.frames, 1U);
  EXPECT_EQ(ready.packets, 4U);
}

TEST_F(StreamSensorTest, Poll_IsAnsweredAtOnce) {
  EncodedPacket buffer;
  line_.Arrive(EncodePoll(99, buffer));
  EXPECT_EQ(Next(), Status::kTimeout);
  const auto messages = line_.TakeReady();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].sequence, 0U);
  EXPECT_EQ(messages[1].sequence, 99U);
}

TEST_F(StreamSensorTest, AnyLostPacket_LosesThatFrameAlone) {
  const auto packets = Packets(1);
  for (std::size_t lost = 0; lost + 1 < packets.size(); ++lost) {
    auto some = packets;
    some.erase(some.begin() + static_cast<std::ptrdiff_t>(lost));
    Send(some);
    EXPECT_EQ(Next(), Status::kCorrupt) << lost;
    Send(Packets(2));
    EXPECT_EQ(Next(), Status::kOk) << lost;
  }
}

TEST_F(StreamSensorTest, LostEnd_LosesThatFrameAlone) {
  auto packets = Packets(1);
  packets.pop_back();
  Send(packets);
  EXPECT_EQ(Next(), Status::kTimeout);
  Send(Packets(2));
  EXPECT_EQ(Next(), Status::kOk);
  const DisflowReady ready = LastReady();
  EXPECT_EQ(ready.frames_lost, 1U);
  EXPECT_EQ(ready.frames, 1U);
}

TEST_F(StreamSensorTest, PacketsOfAnotherFrameInBetween_BreakIt) {
  auto packets = Packets(1);
  packets[2] = Packets(2)[2];
  Send(packets);
  EXPECT_EQ(Next(), Status::kCorrupt);
  EXPECT_EQ(LastReady().frames_lost, 1U);
}

TEST_F(StreamSensorTest, TooLargeFrame_IsRefusedAndCounted) {
  Send(Packets(1, Start(kWidth + 1, kHeight)));
  EXPECT_EQ(Next(), Status::kCorrupt);
  Send(Packets(2, Start(0, 0)));
  EXPECT_EQ(Next(), Status::kCorrupt);
  Send(Packets(3));
  EXPECT_EQ(Next(), Status::kOk);
  const DisflowReady ready = LastReady();
  EXPECT_EQ(ready.frames_refused, 2U);
  EXPECT_EQ(ready.frames_lost, 0U);
}

TEST_F(StreamSensorTest, FrameOfACameraThatCannotImageIt_IsRefusedAndCounted) {
  FrameStart start = Start();
  start.camera.cx_px = 1.7e38F;
  Send(Packets(7, start));
  EXPECT_EQ(Next(), Status::kCorrupt);
  EXPECT_EQ(LastReady().frames_refused, 1U);
}

TEST_F(StreamSensorTest, FrameWithoutUnitOrIntrinsics_IsRefusedAndCounted) {
  FrameStart no_unit = Start(kWidth, kHeight);
  no_unit.unit_m = 0.0F;
  FrameStart no_camera = Start(kWidth, kHeight);
  no_camera.camera.fx_px = -1.0F;
  Send(Packets(1, no_unit));
  EXPECT_EQ(Next(), Status::kCorrupt);
  Send(Packets(2, no_camera));
  EXPECT_EQ(Next(), Status::kCorrupt);
  EXPECT_EQ(LastReady().frames_refused, 2U);
}

TEST_F(StreamSensorTest, EndlessGarbage_EndsTheWaitAllTheSame) {
  line_.Arrive(std::vector<std::byte>(1 << 20, std::byte{0x55}));
  EXPECT_EQ(Next(), Status::kTimeout);
}

TEST_F(StreamSensorTest, FrameThatTakesLongerThanTheWait_IsGoneOnWith) {
  const auto packets = Packets(1);
  Send({packets[0], packets[1]});
  EXPECT_EQ(Next(), Status::kTimeout);
  Send({packets[2], packets[3]});
  EXPECT_EQ(Next(), Status::kOk);
}

TEST_F(StreamSensorTest, Budgets_AreTaken) {
  EncodedPacket buffer;
  line_.Arrive(EncodeBudgets(0, {.frame_us = 40000, .stage_us = 20000}, buffer));
  EXPECT_EQ(Next(), Status::kTimeout);
  EXPECT_EQ(budgets_.frame_us, 40000U);
  EXPECT_EQ(budgets_.stage_us, 20000U);
}

}  // namespace
}  // namespace disflow::hal::depth_stream
