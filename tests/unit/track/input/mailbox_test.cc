// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "input/mask_mailbox.h"
#include "input/pose_mailbox.h"

namespace disflow::apps {
namespace {

constexpr int kWidth_px = 24;
constexpr int kHeight_px = 10;
constexpr std::size_t kPixels = std::size_t{kWidth_px} * kHeight_px;
constexpr std::int64_t kMaxAge_ns = 100;

class MaskMailboxTest : public testing::Test {
 protected:
  void Put(std::int64_t stamp_ns) { Put(mailbox_, stamp_ns); }
  static void Put(MaskMailbox& mailbox, std::int64_t stamp_ns) {
    std::array<std::uint8_t, kPixels> pixels;
    pixels.fill(static_cast<std::uint8_t>(stamp_ns));
    mailbox.Put(stamp_ns, kWidth_px, kHeight_px, kWidth_px, pixels);
  }
  Status Attach(std::int64_t stamp_ns) {
    frame_ = {};
    frame_.depth = {depth_.data(),        kWidth_px, kHeight_px, kWidth_px * 2,
                    DepthFormat::kUint16, 0.001F};
    frame_.stamp_ns = stamp_ns;
    return mailbox_.Attach(frame_);
  }
  /// Whether all pixels of the mask are of one value.
  [[nodiscard]] bool IsWhole() const {
    const std::uint8_t value = frame_.mask.row(0)[0];
    for (int v = 0; v < kHeight_px; ++v) {
      for (int u = 0; u < kWidth_px; ++u) {
        if (frame_.mask.row(v)[u] != value) return false;
      }
    }
    return true;
  }

  MaskMailbox mailbox_{"/mask", kWidth_px, kHeight_px, kMaxAge_ns};
  std::array<std::uint16_t, kPixels> depth_{};
  DepthFrame frame_;
};

TEST_F(MaskMailboxTest, NothingPut_IsCountedAsMissing) {
  EXPECT_EQ(Attach(0), Status::kNotFound);
  EXPECT_FALSE(frame_.mask.given());
  EXPECT_EQ(mailbox_.counters().missing, 1U);
}

TEST_F(MaskMailboxTest, NewestMask_StandsUntilItIsTooOld) {
  Put(1);
  Put(2);
  for (const std::int64_t stamp_ns : {std::int64_t{2}, std::int64_t{50}, 2 + kMaxAge_ns}) {
    ASSERT_EQ(Attach(stamp_ns), Status::kOk);
    EXPECT_EQ(frame_.mask.row(0)[0], 2);
  }
  EXPECT_EQ(Attach(3 + kMaxAge_ns), Status::kTimeout);
  EXPECT_FALSE(frame_.mask.given());
}

TEST_F(MaskMailboxTest, RowsFartherApartThanTheyAreLong_AreReadRight) {
  constexpr std::size_t kStride = kWidth_px + 7;
  std::vector<std::uint8_t> pixels(kStride * kHeight_px, 0xFF);
  for (std::size_t v = 0; v < kHeight_px; ++v) {
    for (std::size_t u = 0; u < kWidth_px; ++u)
      pixels[v * kStride + u] = static_cast<std::uint8_t>(v);
  }
  mailbox_.Put(0, kWidth_px, kHeight_px, kStride, pixels);
  ASSERT_EQ(Attach(0), Status::kOk);
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) ASSERT_EQ(frame_.mask.row(v)[u], v);
  }
}

TEST_F(MaskMailboxTest, SizesThatLie_AreNeverRead) {
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  constexpr auto kFarthest = std::numeric_limits<std::size_t>::max();
  const std::vector<std::uint8_t> pixels(kPixels, 1);
  const auto put = [&](std::int64_t width, std::int64_t height, std::size_t stride,
                       std::size_t bytes) {
    mailbox_.Put(0, width, height, stride, std::span(pixels).first(bytes));
    EXPECT_EQ(Attach(0), Status::kMaskSizeMismatch)
        << width << " " << height << " " << stride << " " << bytes;
    EXPECT_FALSE(frame_.mask.given());
  };
  put(kWidth_px + 1, kHeight_px, kWidth_px, kPixels);
  put(kWidth_px, kHeight_px - 1, kWidth_px, kPixels);
  put(-kWidth_px, -kHeight_px, kWidth_px, kPixels);
  put(kMost, kMost, kWidth_px, kPixels);
  put(kWidth_px, kHeight_px, kWidth_px - 1, kPixels);
  put(kWidth_px, kHeight_px, kWidth_px + 1, kPixels);
  put(kWidth_px, kHeight_px, kFarthest, kPixels);
  put(kWidth_px, kHeight_px, 0, kPixels);
  put(kWidth_px, kHeight_px, kWidth_px, kPixels - 1);
  put(kWidth_px, kHeight_px, kWidth_px, 0);
  EXPECT_EQ(mailbox_.counters().wrong_size, 10U);
  Put(0);
  EXPECT_EQ(Attach(0), Status::kOk);
}

/// The number that all groups of four pixels show. @return -1 if they do not agree.
std::int64_t NumberOf(const MaskView& mask) {
  std::uint32_t first = 0;
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; u += 4) {
      std::uint32_t number = 0;
      std::memcpy(&number, mask.row(v) + u, sizeof(number));
      if (u == 0 && v == 0) first = number;
      if (number != first) return -1;
    }
  }
  return first;
}

TEST_F(MaskMailboxTest, StressOfAFastWriter_MasksAreWholeInOrderAndTheLastArrives) {
  constexpr std::uint32_t kMasks = 500'000;
  MaskMailbox mailbox("/mask", kWidth_px, kHeight_px, /*max_age_ns=*/kMasks);
  std::thread writer([&mailbox] {
    std::array<std::uint32_t, kPixels / 4> numbers;
    for (std::uint32_t i = 1; i <= kMasks; ++i) {
      numbers.fill(i);
      mailbox.Put(i, kWidth_px, kHeight_px, kWidth_px,
                  {reinterpret_cast<const std::uint8_t*>(numbers.data()), kPixels});
    }
  });
  DepthFrame frame;
  frame.depth = {depth_.data(), kWidth_px, kHeight_px, kWidth_px * 2, DepthFormat::kUint16, 0.001F};
  std::int64_t newest = 0;
  std::int64_t wrong = 0;
  while (newest < kMasks && wrong == 0) {
    const Status status = mailbox.Attach(frame);
    if (status == Status::kNotFound && newest == 0) continue;
    const std::int64_t number = frame.mask.given() ? NumberOf(frame.mask) : -1;
    if (number < newest) ++wrong;
    newest = number;
  }
  writer.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(newest, kMasks);
  EXPECT_EQ(mailbox.counters().late + mailbox.counters().wrong_size, 0U);
}

/// A pose that shows its number in each coordinate.
PoseMailbox::Pose Numbered(std::int64_t number) {
  const auto value = static_cast<double>(number);
  return {Mat<double, 3, 3>::Identity(), Mat<double, 3>(value, value, value)};
}

TEST(PoseMailbox, FullMailbox_KeepsTheNewestInOrder) {
  constexpr std::int64_t kPoses = PoseMailbox::kCapacity + 5;
  PoseMailbox mailbox;
  for (std::int64_t i = 1; i <= kPoses; ++i) mailbox.Put(i, Numbered(i));
  hal::CameraPoseHistory history({});
  mailbox.MoveTo(history, /*now_ns=*/0);
  // In order, or the history would have refused some.
  EXPECT_EQ(history.counters().poses, PoseMailbox::kCapacity);
  EXPECT_EQ(history.counters().refused, 0U);
  mailbox.MoveTo(history, /*now_ns=*/0);
  EXPECT_EQ(history.counters().poses, PoseMailbox::kCapacity);
}

TEST(PoseMailbox, StressOfAFastWriter_PosesAreWholeInOrderAndTheLastArrives) {
  constexpr std::int64_t kPoses = 1'000'000;
  PoseMailbox mailbox;
  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (std::int64_t i = 1; i <= kPoses; ++i) mailbox.Put(i, Numbered(i));
    done = true;
  });
  hal::CameraPoseHistory history({});
  while (!done) mailbox.MoveTo(history, /*now_ns=*/0);
  writer.join();
  mailbox.MoveTo(history, /*now_ns=*/0);
  EXPECT_EQ(history.counters().refused, 0U) << "they came in order, each once";
  Transform<World, Camera> T_wc;
  ASSERT_EQ(history.At(kPoses, T_wc), Status::kOk);
  const auto last = static_cast<float>(kPoses);
  EXPECT_EQ(T_wc.translation(), Vec3(last, last, last));
}

}  // namespace
}  // namespace disflow::apps
