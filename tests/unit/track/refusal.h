// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "program/exit_status.h"

namespace disflow::apps {

/// @return What is said with that exit status; empty if the action is let through.
template <class Action>
[[nodiscard]] std::string RefusalOf(Action&& action, ExitStatus status = kWrongUsage) {
  try {
    action();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.status(), status);
    return failure.what();
  }
  return "";
}

}  // namespace disflow::apps
