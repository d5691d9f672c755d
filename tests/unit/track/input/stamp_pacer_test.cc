// SPDX-License-Identifier: BSD-3-Clause
#include "input/stamp_pacer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>

namespace disflow::apps {
namespace {

constexpr std::int64_t kFrame_ns = 33'333'333;
constexpr std::int64_t kStart_ns = 1'000'000'000'000;

TEST(StampPacer, EvenStamps_AreDueAtTheirDistance) {
  StampPacer pacer;
  for (std::int64_t i = 0; i < 100; ++i) {
    const std::int64_t due_ns = kStart_ns + i * kFrame_ns;
    EXPECT_EQ(pacer.DueNs(77 + i * kFrame_ns, due_ns), due_ns);
  }
}

TEST(StampPacer, GapWithinBound_IsWaitedFor) {
  StampPacer pacer;
  EXPECT_EQ(pacer.DueNs(0, kStart_ns), kStart_ns);
  EXPECT_EQ(pacer.DueNs(StampPacer::kLongestGap_ns, kStart_ns),
            kStart_ns + StampPacer::kLongestGap_ns);
}

TEST(StampPacer, StampFarAhead_IsDueAtOnceAndTheRestKeepsItsPace) {
  StampPacer pacer;
  std::int64_t now_ns = kStart_ns;
  ASSERT_EQ(pacer.DueNs(0, now_ns), now_ns);
  now_ns = pacer.DueNs(kFrame_ns, now_ns);
  EXPECT_EQ(pacer.DueNs(kFrame_ns + StampPacer::kLongestGap_ns + 1, now_ns), now_ns);
  // It was this one stamp: the next is as if nothing had been.
  EXPECT_EQ(pacer.DueNs(2 * kFrame_ns, now_ns), now_ns);
  EXPECT_EQ(pacer.DueNs(3 * kFrame_ns, now_ns), now_ns + kFrame_ns);
}

TEST(StampPacer, RecordingOfTwoParts_GoesOnFromTheJump) {
  constexpr std::int64_t kLater_ns = 3'600'000'000'000;
  StampPacer pacer;
  ASSERT_EQ(pacer.DueNs(0, kStart_ns), kStart_ns);
  ASSERT_EQ(pacer.DueNs(kLater_ns, kStart_ns + 1), kStart_ns + 1);
  EXPECT_EQ(pacer.DueNs(kLater_ns + kFrame_ns, kStart_ns + 1), kStart_ns + 1 + kFrame_ns);
}

TEST(StampPacer, StampBackwards_IsDueAtOnceAndTheRestKeepsItsPace) {
  StampPacer pacer;
  ASSERT_EQ(pacer.DueNs(50 * kFrame_ns, kStart_ns), kStart_ns);
  ASSERT_EQ(pacer.DueNs(0, kStart_ns + kFrame_ns), kStart_ns + kFrame_ns);
  EXPECT_EQ(pacer.DueNs(kFrame_ns, kStart_ns + kFrame_ns), kStart_ns + 2 * kFrame_ns);
}

TEST(StampPacer, SlowTaker_GetsNoBurstAfterwards) {
  StampPacer pacer;
  ASSERT_EQ(pacer.DueNs(0, kStart_ns), kStart_ns);
  const std::int64_t late_ns = kStart_ns + 10'000'000'000;
  EXPECT_LE(pacer.DueNs(kFrame_ns, late_ns), late_ns);
  EXPECT_EQ(pacer.DueNs(2 * kFrame_ns, late_ns), late_ns + kFrame_ns);
}

TEST(StampPacer, AnyStamps_WaitIsBoundedAndNothingOverflows) {
  std::mt19937_64 random(5);
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::array kHostile = {
      kLeast, kLeast + 1, std::int64_t{-1}, std::int64_t{0}, kFrame_ns, kMost - 1, kMost};
  StampPacer pacer;
  std::int64_t now_ns = kStart_ns;
  for (int i = 0; i < 10'000; ++i) {
    const bool hostile = random() % 2 == 0;
    const auto stamp_ns = hostile ? kHostile[static_cast<std::size_t>(random() % kHostile.size())]
                                  : static_cast<std::int64_t>(random());
    const std::int64_t due_ns = pacer.DueNs(stamp_ns, now_ns);
    ASSERT_LE(due_ns, now_ns + StampPacer::kLongestGap_ns) << stamp_ns;
    now_ns = std::max(now_ns, due_ns);
  }
}

}  // namespace
}  // namespace disflow::apps
