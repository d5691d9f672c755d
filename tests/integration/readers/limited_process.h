// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace disflow::test {

/// How a function ended that had little memory and time.
struct LimitedOutcome {
  int signal = 0;       ///< That ended it, or 0.
  std::string message;  ///< What it returned.
};

/// Seconds of a processor's time: three times what is promised of a quiet machine. Where others
/// compile beside it and memory is short, what takes 0.4 s there has taken more than one.
inline constexpr unsigned kMostTime_s = 3;

/// Runs a function in a process of its own that has 256 MB more than this one, and kMostTime_s, or
/// as many seconds as are given: more than it needs, far less than what grows with the square of
/// the input takes.
[[nodiscard]] LimitedOutcome RunLimited(const std::function<std::string()>& function,
                                        unsigned most_s = kMostTime_s);

}  // namespace disflow::test
