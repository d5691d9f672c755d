// SPDX-License-Identifier: BSD-3-Clause
#include "run/recording_queue.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

#include "held_recording.h"

namespace disflow::apps {
namespace {

constexpr int kWidth_px = 20;
constexpr int kHeight_px = 10;
constexpr RecordingQueue::Room kRoom{
    .width_px = kWidth_px, .height_px = kHeight_px, .objects = 1, .model_samples = 0};

/// Frames that are told apart by every one of their pixels.
class RecordingQueueTest : public ::testing::Test {
 protected:
  std::unique_ptr<RecordingWriter> NewWriter(std::vector<Written>& written, int room = 1'000'000) {
    return std::make_unique<RecordingWriter>(std::make_unique<HeldRecording>(disk_, written, room));
  }

  /// @return Whether it was taken.
  bool Put(RecordingQueue& queue, RecordingWriter& writer, int number) {
    // One image for all, as a driver may have it.
    depth_m_.assign(kWidth_px * kHeight_px, DepthOf(number));
    mask_.assign(kWidth_px * kHeight_px, static_cast<std::uint8_t>(number));
    DepthFrame frame;
    frame.depth = {depth_m_.data(),       kWidth_px, kHeight_px, 4 * kWidth_px,
                   DepthFormat::kFloat32, 0.001F};
    frame.mask = {mask_.data(), kWidth_px, kHeight_px, kWidth_px};
    frame.stamp_ns = number;
    FrameResult result;
    result.frame = number;
    return queue.Put(writer, &frame, {&result, 1}, nullptr).frame;
  }

  static float DepthOf(int number) { return 0.5F + 0.125F * static_cast<float>(number); }

  static void ExpectIs(const Written& written, int number) {
    EXPECT_EQ(written.stamp_ns, number);
    EXPECT_EQ(written.depth_m, DepthOf(number));
    EXPECT_EQ(written.mask, number);
    EXPECT_EQ(written.result, number);
  }

  HeldDisk disk_;
  std::vector<float> depth_m_;
  std::vector<std::uint8_t> mask_;
};

/// If a frame waited for the disk, nobody would be left to release it and the test would not end.
TEST_F(RecordingQueueTest, DiskThatBlocks_HoldsNobodyUpAndWhatFindsNoRoomIsCounted) {
  constexpr int kLeftOut = 25;
  std::vector<Written> written;
  const auto writer = NewWriter(written);
  RecordingQueue queue(kRoom);
  const int kept = static_cast<int>(queue.capacity());
  for (int i = 0; i < kept + kLeftOut; ++i) EXPECT_EQ(Put(queue, *writer, i), i < kept) << i;
  EXPECT_EQ(queue.dropped(), static_cast<std::uint32_t>(kLeftOut));
  EXPECT_EQ(writer->frame_count(), 0);

  disk_.Allow(kept);
  queue.AwaitWritten();
  ASSERT_EQ(written.size(), queue.capacity());
  for (int i = 0; i < kept; ++i) ExpectIs(written[static_cast<std::size_t>(i)], i);

  disk_.Allow(1);
  EXPECT_TRUE(Put(queue, *writer, 200)) << "it goes on where it can";
  queue.AwaitWritten();
  ExpectIs(written.back(), 200);
  EXPECT_EQ(queue.dropped(), static_cast<std::uint32_t>(kLeftOut));
  EXPECT_EQ(writer->frame_count(), kept + 1);
}

TEST_F(RecordingQueueTest, DiskThatKeepsUp_GetsEveryFrameInOrderManyTimesAround) {
  constexpr int kFrames = 200;
  std::vector<Written> written;
  const auto writer = NewWriter(written);
  disk_.Allow(kFrames);
  RecordingQueue queue(kRoom);
  for (int i = 0; i < kFrames; ++i) {
    if (i % 20 == 0) queue.AwaitWritten();
    EXPECT_TRUE(Put(queue, *writer, i));
  }
  queue.AwaitWritten();
  ASSERT_EQ(written.size(), static_cast<std::size_t>(kFrames));
  for (int i = 0; i < kFrames; ++i) ExpectIs(written[static_cast<std::size_t>(i)], i);
  EXPECT_EQ(queue.dropped(), 0U);
}

TEST_F(RecordingQueueTest, AtItsEnd_WritesWhatWaits) {
  std::vector<Written> written;
  const auto writer = NewWriter(written);
  {
    RecordingQueue queue(kRoom);
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(Put(queue, *writer, i));
    disk_.Allow(10);
  }
  EXPECT_EQ(written.size(), 10U);
}

TEST_F(RecordingQueueTest, FrameThatCouldNotBeRead_IsWrittenAsSuch) {
  std::vector<Written> written;
  const auto writer = NewWriter(written);
  disk_.Allow(2);
  RecordingQueue queue(kRoom);
  EXPECT_TRUE(Put(queue, *writer, 1));
  FrameResult result;
  result.frame = 2;
  EXPECT_TRUE(queue.Put(*writer, nullptr, {&result, 1}, nullptr).frame);
  queue.AwaitWritten();
  ASSERT_EQ(written.size(), 2U);
  EXPECT_EQ(written[1].stamp_ns, -1);
  EXPECT_EQ(written[1].result, 2);
}

TEST_F(RecordingQueueTest, TwoRecordings_EachGetItsOwnAndOneThatFailedHarmsNoOther) {
  std::vector<Written> first;
  std::vector<Written> second;
  const auto full = NewWriter(first, 3);
  const auto next = NewWriter(second);
  RecordingQueue queue(kRoom);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(Put(queue, i < 6 ? *full : *next, i));
  EXPECT_FALSE(full->has_failed());
  disk_.Allow(3 + 1 + 4);  // the one that fails among them
  queue.AwaitWritten();
  EXPECT_TRUE(full->has_failed());
  EXPECT_EQ(full->failure(), "held: cannot be written; nothing more is recorded after 3 frames");
  EXPECT_EQ(first.size(), 3U);
  EXPECT_FALSE(next->has_failed());
  ASSERT_EQ(second.size(), 4U);
  for (int i = 0; i < 4; ++i) ExpectIs(second[static_cast<std::size_t>(i)], 6 + i);
}

TEST(RecordingQueueRoom, IsASecondOfCommonImagesAndFewerOfLargeOnes) {
  const auto capacity = [](int width_px, int height_px) {
    return RecordingQueue({.width_px = width_px, .height_px = height_px}).capacity();
  };
  EXPECT_EQ(capacity(0, 0), 30U) << "of a size that is not known yet";
  EXPECT_EQ(capacity(640, 360), 30U);
  EXPECT_EQ(capacity(848, 480), 30U);
  EXPECT_EQ(capacity(1280, 720), 14U);
  EXPECT_EQ(capacity(1920, 1200), 5U);
}

}  // namespace
}  // namespace disflow::apps
