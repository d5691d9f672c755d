// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/monotonic_clock.h"

#include <cerrno>
#include <ctime>

#include "disflow/posix/timespec.h"
#include "disflow/types.h"

namespace disflow::posix {

std::int64_t MonotonicClock::DoNowNs() noexcept {
  timespec now{};
  // Cannot fail: the clock exists on every Linux and the pointer is valid.
  (void)::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * kSecond_ns + now.tv_nsec;
}

void MonotonicClock::DoSleepUntilNs(std::int64_t deadline_ns) noexcept {
  if (deadline_ns <= 0) return;
  const timespec deadline = ToTimespec(deadline_ns);
  // An absolute deadline, so that signals do not prolong the wait.
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace disflow::posix
