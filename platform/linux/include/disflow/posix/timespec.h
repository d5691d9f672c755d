// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <ctime>

#include "disflow/types.h"

namespace disflow::posix {

/// A span or a time as the system's calls take it; both members have 32 bits on small targets.
/// @param ns Nanoseconds, not negative.
[[nodiscard]] inline timespec ToTimespec(std::int64_t ns) noexcept {
  timespec time{};
  time.tv_sec = static_cast<std::time_t>(ns / kSecond_ns);
  time.tv_nsec = static_cast<decltype(time.tv_nsec)>(ns % kSecond_ns);
  return time;
}

}  // namespace disflow::posix
