// SPDX-License-Identifier: BSD-3-Clause
#include "camera/frame_stamp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace disflow::posix {
namespace {

TEST(FrameStamp, DaysAndYearsOfUptime_KeepTheirMicroseconds) {
  v4l2_buffer buffer{};
  constexpr std::int64_t kYear_s = 365LL * 24 * 3600;
  // 68 years where seconds have 32 bits.
  constexpr std::int64_t kMost_s =
      std::min<std::int64_t>(100 * kYear_s, std::numeric_limits<time_t>::max());
  for (const std::int64_t seconds : {std::int64_t{0}, std::int64_t{4'294'967}, kMost_s}) {
    buffer.timestamp.tv_sec = static_cast<time_t>(seconds);
    buffer.timestamp.tv_usec = 999'999;
    EXPECT_EQ(StampNsOf(buffer), seconds * 1'000'000'000 + 999'999'000);
  }
}

TEST(FrameStamp, MonotonicClockAndMoment_AreReadFromTheFlags) {
  v4l2_buffer buffer{};
  EXPECT_FALSE(IsMonotonic(buffer));
  buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_COPY;
  EXPECT_FALSE(IsMonotonic(buffer));
  buffer.flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_ERROR;
  EXPECT_TRUE(IsMonotonic(buffer));
  EXPECT_EQ(StampPointOf(buffer), hal::StampPoint::kEndOfFrame);
  buffer.flags |= V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  EXPECT_EQ(StampPointOf(buffer), hal::StampPoint::kStartOfExposure);
}

TEST(SequenceCheck, Gaps_AreCountedAcrossTheWrap) {
  SequenceCheck check;
  EXPECT_EQ(check.Judge(0xFFFFFFFE).missing, 0U);
  EXPECT_EQ(check.Judge(0xFFFFFFFF).missing, 0U);
  EXPECT_EQ(check.Judge(0).missing, 0U);
  EXPECT_EQ(check.Judge(4).missing, 3U);
}

TEST(SequenceCheck, FrameThatIsOvertaken_IsLateAndNoSecondGap) {
  SequenceCheck check;
  EXPECT_EQ(check.Judge(10).missing, 0U);
  EXPECT_EQ(check.Judge(12).missing, 1U);
  EXPECT_TRUE(check.Judge(11).late);
  const SequenceCheck::Verdict next = check.Judge(13);
  EXPECT_EQ(next.missing, 0U);
  EXPECT_FALSE(next.late);
}

TEST(SequenceCheck, CounterThatStartsAnewOrStandsStill_IsNoGap) {
  SequenceCheck check;
  for (const std::uint32_t sequence : {1000U, 0U, 0U}) {
    EXPECT_EQ(check.Judge(sequence).missing, 0U);
  }
  check.Restart();
  EXPECT_EQ(check.Judge(50).missing, 0U);
}

}  // namespace
}  // namespace disflow::posix
