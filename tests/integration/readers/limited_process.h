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

/// Runs a function in a process of its own that has 256 MB more than this one, and 1 s of a
/// processor's time, or as many as are given: far more than it needs, far less than what grows with
/// the square of the input takes.
[[nodiscard]] LimitedOutcome RunLimited(const std::function<std::string()>& function,
                                        unsigned most_s = 1);

}  // namespace disflow::test
