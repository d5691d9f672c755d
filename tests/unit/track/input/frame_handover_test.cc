// SPDX-License-Identifier: BSD-3-Clause
#include "input/frame_handover.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace disflow::apps {
namespace {

using Taken = FrameHandover::Taken;

constexpr int kWidth_px = 16;
constexpr int kHeight_px = 8;
constexpr std::size_t kPixels = std::size_t{kWidth_px} * kHeight_px;
/// Never reached: a test that waited so long has failed.
constexpr std::int64_t kLong_ns = 60'000'000'000;
constexpr std::int64_t kNotAtAll_ns = 0;

/// A frame that shows its number in every pixel of depth and mask and in its stamp.
class NumberedFrame {
 public:
  const DepthFrame& Set(std::int64_t number, bool with_mask = true) {
    depth_.fill(static_cast<std::uint16_t>(number));
    mask_.fill(static_cast<std::uint8_t>(number));
    frame_ = {};
    frame_.stamp_ns = number;
    frame_.depth = {depth_.data(),        kWidth_px, kHeight_px, kWidth_px * 2,
                    DepthFormat::kUint16, 0.001F};
    if (with_mask) {
      frame_.mask.data = mask_.data();
      frame_.mask.width_px = kWidth_px;
      frame_.mask.height_px = kHeight_px;
      frame_.mask.stride_bytes = kWidth_px;
    }
    return frame_;
  }

 private:
  std::array<std::uint16_t, kPixels> depth_{};
  std::array<std::uint8_t, kPixels> mask_{};
  DepthFrame frame_;
};

/// Whether every pixel is of the frame's own number.
bool IsWhole(const DepthFrame& frame) {
  for (int v = 0; v < kHeight_px; ++v) {
    std::array<std::uint16_t, kWidth_px> row{};
    std::memcpy(row.data(), frame.depth.row(v), sizeof(row));
    for (int u = 0; u < kWidth_px; ++u) {
      if (row[static_cast<std::size_t>(u)] != static_cast<std::uint16_t>(frame.stamp_ns))
        return false;
      if (frame.mask.given() && frame.mask.row(v)[u] != static_cast<std::uint8_t>(frame.stamp_ns))
        return false;
    }
  }
  return true;
}

class FrameHandoverTest : public testing::Test {
 protected:
  Taken Take(std::int64_t timeout_ns = kNotAtAll_ns) {
    return handover_.Take(timeout_ns, frame_, fault_);
  }
  void SayTaken(int count) {
    taken_ = count;
    taken_.notify_one();
  }

  FrameHandover handover_{kWidth_px, kHeight_px, true};
  NumberedFrame numbered_;
  DepthFrame frame_;
  Status fault_ = Status::kOk;
  std::atomic<int> taken_ = 0;  ///< So many of what the capture thread put.
};

TEST_F(FrameHandoverTest, NothingPut_GivesNothing) { EXPECT_EQ(Take(), Taken::kNothing); }

TEST_F(FrameHandoverTest, FrameNotTaken_IsReplacedAndCounted) {
  handover_.Put(numbered_.Set(1));
  handover_.Put(numbered_.Set(2));
  handover_.Put(numbered_.Set(3));
  ASSERT_EQ(Take(), Taken::kFrame);
  EXPECT_EQ(frame_.stamp_ns, 3);
  EXPECT_TRUE(IsWhole(frame_));
  EXPECT_EQ(handover_.dropped(), 2U);
  EXPECT_EQ(Take(), Taken::kNothing);
}

TEST_F(FrameHandoverTest, FrameTaken_StaysAsItIsWhileOthersArePut) {
  handover_.Put(numbered_.Set(1));
  ASSERT_EQ(Take(), Taken::kFrame);
  for (int i = 2; i < 6; ++i) handover_.Put(numbered_.Set(i));
  EXPECT_EQ(frame_.stamp_ns, 1);
  EXPECT_TRUE(IsWhole(frame_));
}

TEST_F(FrameHandoverTest, FaultBehindAFrame_IsLeftOut) {
  handover_.Put(numbered_.Set(1));
  handover_.PutFault(Status::kCorrupt);
  ASSERT_EQ(Take(), Taken::kFrame);
  EXPECT_EQ(Take(), Taken::kNothing);
}

TEST_F(FrameHandoverTest, FrameBehindAFault_TakesItsPlaceAndIsNoDrop) {
  handover_.PutFault(Status::kCorrupt);
  handover_.Put(numbered_.Set(1));
  ASSERT_EQ(Take(), Taken::kFrame);
  EXPECT_EQ(handover_.dropped(), 0U);
  handover_.PutFault(Status::kTruncated);
  ASSERT_EQ(Take(), Taken::kFault);
  EXPECT_EQ(fault_, Status::kTruncated);
}

TEST_F(FrameHandoverTest, FrameWithoutMask_HasNoneOfAnEarlierFrame) {
  for (int i = 0; i < 4; ++i) {
    handover_.Put(numbered_.Set(i, /*with_mask=*/i % 2 == 0));
    ASSERT_EQ(Take(), Taken::kFrame);
    EXPECT_EQ(frame_.mask.given(), i % 2 == 0);
  }
}

TEST_F(FrameHandoverTest, FrameLargerThanTheBuffers_IsTakenWhole) {
  FrameHandover small(2, 2, false);
  small.Put(numbered_.Set(9));
  ASSERT_EQ(small.Take(kNotAtAll_ns, frame_, fault_), Taken::kFrame);
  EXPECT_TRUE(IsWhole(frame_));
  EXPECT_TRUE(frame_.mask.given());
}

TEST_F(FrameHandoverTest, End_ComesAfterTheFrameThatWaits) {
  handover_.Put(numbered_.Set(1));
  handover_.End(nullptr);
  EXPECT_EQ(Take(), Taken::kFrame);
  EXPECT_EQ(Take(kLong_ns), Taken::kEnd);
  EXPECT_EQ(Take(kLong_ns), Taken::kEnd);
}

TEST_F(FrameHandoverTest, FailureAtTheEnd_IsThrownOnceAndAfterTheFrameThatWaits) {
  handover_.Put(numbered_.Set(1));
  handover_.End(std::make_exception_ptr(std::runtime_error("unplugged")));
  EXPECT_EQ(Take(), Taken::kFrame);
  EXPECT_THROW((void)Take(kLong_ns), std::runtime_error);
  EXPECT_EQ(Take(kLong_ns), Taken::kEnd);
}

TEST_F(FrameHandoverTest, TakerThatSleeps_IsWokenByFrameFaultAndEnd) {
  std::thread capture([this] {
    NumberedFrame numbered;
    handover_.Put(numbered.Set(1));
    taken_.wait(0);
    handover_.PutFault(Status::kCorrupt);
    taken_.wait(1);
    handover_.End(nullptr);
  });
  EXPECT_EQ(Take(kLong_ns), Taken::kFrame);
  SayTaken(1);
  EXPECT_EQ(Take(kLong_ns), Taken::kFault);
  SayTaken(2);
  EXPECT_EQ(Take(kLong_ns), Taken::kEnd);
  capture.join();
}

TEST_F(FrameHandoverTest, StressOfFramesAndFaults_IsWholeInOrderAndComplete) {
  constexpr std::int64_t kFrames = 300'000;
  std::thread capture([this] {
    NumberedFrame numbered;
    for (std::int64_t i = 1; i <= kFrames; ++i) {
      handover_.Put(numbered.Set(i, i % 3 != 0));
      if (i % 5 == 0) handover_.PutFault(Status::kCorrupt);
    }
    handover_.End(nullptr);
  });
  std::int64_t frames = 0;
  std::int64_t newest = 0;
  std::int64_t wrong = 0;
  for (Taken taken = Taken::kNothing; taken != Taken::kEnd;) {
    taken = Take(kLong_ns);
    if (taken == Taken::kNothing) ++wrong;  // a wake-up was lost
    if (taken == Taken::kFault && fault_ != Status::kCorrupt) ++wrong;
    if (taken != Taken::kFrame) continue;
    ++frames;
    if (frame_.stamp_ns <= newest || !IsWhole(frame_)) ++wrong;
    if (frame_.mask.given() == (frame_.stamp_ns % 3 == 0)) ++wrong;
    newest = frame_.stamp_ns;
  }
  capture.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(newest, kFrames) << "the last frame never makes way";
  EXPECT_EQ(frames + handover_.dropped(), kFrames);
}

/// A pipe, whose readable end is what a tracking thread also waits for.
class Pipe {
 public:
  Pipe() {
    int ends[2] = {-1, -1};
    EXPECT_EQ(::pipe(ends), 0);
    out = posix::FileDescriptor(ends[0]);
    in = posix::FileDescriptor(ends[1]);
  }
  void Write() const { EXPECT_EQ(::write(in.get(), "x", 1), 1); }
  posix::FileDescriptor out;
  posix::FileDescriptor in;
};

TEST_F(FrameHandoverTest, Input_EndsTheWaitAndLeavesTheFrameTakenBefore) {
  const Pipe pipe;
  const int inputs[] = {-1, pipe.out.get()};
  handover_.Put(numbered_.Set(1));
  ASSERT_EQ(handover_.Take(kLong_ns, frame_, fault_, inputs), Taken::kFrame);
  EXPECT_EQ(handover_.Take(kNotAtAll_ns, frame_, fault_, inputs), Taken::kNothing);
  pipe.Write();
  EXPECT_EQ(handover_.Take(kLong_ns, frame_, fault_, inputs), Taken::kInput);
  EXPECT_EQ(frame_.stamp_ns, 1);
  EXPECT_TRUE(IsWhole(frame_));
}

TEST_F(FrameHandoverTest, FrameBesideInput_GoesFirst) {
  const Pipe pipe;
  const int inputs[] = {pipe.out.get()};
  pipe.Write();
  handover_.Put(numbered_.Set(1));
  EXPECT_EQ(handover_.Take(kLong_ns, frame_, fault_, inputs), Taken::kFrame);
  handover_.End(nullptr);
  EXPECT_EQ(handover_.Take(kLong_ns, frame_, fault_, inputs), Taken::kEnd);
}

TEST_F(FrameHandoverTest, BrokenInput_IsLeftOut) {
  Pipe pipe;
  const int inputs[] = {pipe.out.get()};
  pipe.in.Reset();  // Hung up: it would end every wait at once.
  constexpr std::int64_t kMoment_ns = 20'000'000;
  EXPECT_EQ(handover_.Take(kMoment_ns, frame_, fault_, inputs), Taken::kNothing);
  handover_.Put(numbered_.Set(1));
  EXPECT_EQ(handover_.Take(kLong_ns, frame_, fault_, inputs), Taken::kFrame);
}

TEST_F(FrameHandoverTest, StressInLockStep_EveryWakeUpArrives) {
  constexpr int kFrames = 1'000;
  std::thread capture([this] {
    NumberedFrame numbered;
    for (int i = 1; i <= kFrames; ++i) {
      handover_.Put(numbered.Set(i));
      taken_.wait(i - 1);
    }
  });
  int wrong = 0;
  for (int i = 1; i <= kFrames; ++i) {
    if (Take(kLong_ns) != Taken::kFrame || frame_.stamp_ns != i || !IsWhole(frame_)) ++wrong;
    SayTaken(i);
  }
  capture.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(handover_.dropped(), 0U);
}

}  // namespace
}  // namespace disflow::apps
