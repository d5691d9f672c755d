// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/sender_clock.h"

#include <gtest/gtest.h>

#include <limits>

namespace disflow::hal {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStep_ns = 20 * kMs;
constexpr std::int64_t kOffset_ns = 86'400'000 * kMs;

/// A sender whose messages take 2 to 12 ms.
class Sender {
 public:
  /// @param error_ns What its stamp is wrong by. @return How far the answer is from the truth.
  std::int64_t Send(SenderClock& clock, std::int64_t error_ns = 0) {
    ++sent_;
    const std::int64_t sender_ns = sent_ * kStep_ns + ahead_ns_;
    const std::int64_t now_ns = sent_ * kStep_ns + kOffset_ns + (2 + (sent_ * 7) % 11) * kMs;
    last_ = clock.ToOwn(sender_ns + error_ns, now_ns);
    return last_.value - sent_ * kStep_ns - kOffset_ns;
  }
  void Jump(std::int64_t by_ns) { ahead_ns_ += by_ns; }
  [[nodiscard]] bool refused() const { return !last_.ok(); }

 private:
  std::int64_t sent_ = 0;
  std::int64_t ahead_ns_ = 0;
  Expected<StampNs> last_;
};

TEST(SenderClock, Offset_IsThatOfTheQuickestMessages) {
  SenderClock clock;
  Sender sender;
  for (int i = 0; i < 50; ++i) (void)sender.Send(clock);
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(static_cast<double>(sender.Send(clock)), 2e6, 1e5);
}

TEST(SenderClock, OneWrongStamp_LeavesTheOthersAsTheyAre) {
  for (const std::int64_t error_ns :
       {20 * kMs, 49 * kMs, 51 * kMs, 300 * kMs, std::int64_t{1} << 60, -49 * kMs, -100 * kMs,
        -300 * kMs, -(std::int64_t{1} << 60)}) {
    SenderClock disturbed;
    SenderClock clock;
    Sender sender;
    Sender same;
    for (int i = 0; i < 200; ++i) {
      const bool is_wrong = i == 100;
      const std::int64_t a = sender.Send(disturbed, is_wrong ? error_ns : 0);
      const std::int64_t b = same.Send(clock);
      if (is_wrong && (error_ns > 51 * kMs || error_ns < -300 * kMs)) {
        EXPECT_TRUE(sender.refused()) << error_ns;
      }
      if (is_wrong) continue;
      ASSERT_FALSE(sender.refused()) << error_ns;
      // A drift of the clocks is allowed for between two messages.
      ASSERT_NEAR(static_cast<double>(a), static_cast<double>(b), 1e4) << error_ns << " " << i;
    }
  }
}

TEST(SenderClock, ClockThatIsSet_IsLearntWithinAThirdOfASecond) {
  for (const std::int64_t by_ns : {-100 * kMs, -400 * kMs, -5'000 * kMs, -kOffset_ns, 100 * kMs,
                                   400 * kMs, 5'000 * kMs, std::int64_t{1} << 60}) {
    SenderClock clock;
    Sender sender;
    for (int i = 0; i < 100; ++i) (void)sender.Send(clock);
    sender.Jump(by_ns);
    for (int i = 0; i < 17; ++i) (void)sender.Send(clock);
    for (int i = 0; i < 100; ++i) {
      // As good as at the start: a message's time on the way.
      EXPECT_NEAR(static_cast<double>(sender.Send(clock)), 7e6, 6e6) << by_ns << " " << i;
      ASSERT_FALSE(sender.refused()) << by_ns << " " << i;
    }
  }
}

TEST(SenderClock, WrongStampsWhileAClockIsLearnt_DoNotKeepItFromBeingLearnt) {
  SenderClock clock;
  Sender sender;
  for (int i = 0; i < 100; ++i) (void)sender.Send(clock);
  sender.Jump(-5'000 * kMs);
  for (int i = 0; i < 20; ++i) (void)sender.Send(clock, i % 4 == 3 ? (i - 10) * 777 * kMs : 0);
  EXPECT_NEAR(static_cast<double>(sender.Send(clock)), 7e6, 6e6);
  EXPECT_FALSE(sender.refused());
}

TEST(SenderClock, MessagesThatWaitedInAQueue_DoNotMoveTheClock) {
  SenderClock clock;
  for (int i = 0; i < 50; ++i) (void)clock.ToOwn(i * kStep_ns, i * kStep_ns + kOffset_ns);
  // Nobody has looked for two seconds.
  const std::int64_t now_ns = 150 * kStep_ns + kOffset_ns;
  for (int i = 50; i <= 150; ++i) {
    const Expected<StampNs> stamp = clock.ToOwn(i * kStep_ns, now_ns);
    if (!stamp.ok()) continue;
    EXPECT_NEAR(static_cast<double>(stamp.value - i * kStep_ns - kOffset_ns), 0.0, 1e6);
  }
  EXPECT_EQ(clock.ToOwn(150 * kStep_ns, now_ns).status, Status::kOk);
}

TEST(SenderClock, ClocksThatRunApart_AreFollowed) {
  SenderClock clock;
  constexpr std::int64_t kApart = 20'000;  // 50 ppm
  for (std::int64_t t = 0; t < 1'000'000 * kMs; t += kStep_ns) {
    const Expected<StampNs> stamp = clock.ToOwn(t - t / kApart, t);
    ASSERT_TRUE(stamp.ok()) << t;
    EXPECT_LE(t - stamp.value, 1 * kMs);
  }
}

}  // namespace
}  // namespace disflow::hal
