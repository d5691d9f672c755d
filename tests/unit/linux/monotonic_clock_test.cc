// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/monotonic_clock.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/time.h>

namespace disflow::posix {
namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;

TEST(MonotonicClock, Time_NeverRunsBackwards) {
  MonotonicClock clock;
  std::int64_t last_ns = clock.NowNs();
  EXPECT_GT(last_ns, 0);
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t now_ns = clock.NowNs();
    ASSERT_GE(now_ns, last_ns);
    last_ns = now_ns;
  }
}

TEST(MonotonicClock, Sleep_EndsAtTheDeadlineOrLater) {
  MonotonicClock clock;
  const std::int64_t deadline_ns = clock.NowNs() + 5 * kNsPerMs;
  clock.SleepUntilNs(deadline_ns);
  EXPECT_GE(clock.NowNs(), deadline_ns);
}

TEST(MonotonicClock, DeadlineInThePast_ReturnsAtOnce) {
  MonotonicClock clock;
  // Each would take a second or more if it were taken as a duration. A busy machine takes longer
  // for all of them than for one, but not half a second for each.
  constexpr int kSleeps = 40;
  const std::int64_t start_ns = clock.NowNs();
  for (int i = 0; i < kSleeps; ++i) clock.SleepUntilNs(clock.NowNs() - 1000 * kNsPerMs);
  clock.SleepUntilNs(0);
  clock.SleepUntilNs(-1);
  EXPECT_LT(clock.NowNs() - start_ns, kSleeps * 500 * kNsPerMs);
}

TEST(MonotonicClock, Signals_DoNotShortenASleep) {
  struct sigaction ignore_alarm {};
  ignore_alarm.sa_handler = [](int) {};
  ASSERT_EQ(::sigaction(SIGALRM, &ignore_alarm, nullptr), 0);
  const itimerval every_ms{{0, 1000}, {0, 1000}};
  ASSERT_EQ(::setitimer(ITIMER_REAL, &every_ms, nullptr), 0);
  MonotonicClock clock;
  const std::int64_t deadline_ns = clock.NowNs() + 20 * kNsPerMs;
  clock.SleepUntilNs(deadline_ns);
  EXPECT_GE(clock.NowNs(), deadline_ns);
  const itimerval off{};
  ASSERT_EQ(::setitimer(ITIMER_REAL, &off, nullptr), 0);
}

}  // namespace
}  // namespace disflow::posix
