// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "program/exit_status.h"

namespace disflow::apps {

/// @return What is said of wrong usage; empty if the action is let through.
template <class Action>
[[nodiscard]] std::string RefusalOf(Action&& action) {
  try {
    action();
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.status(), kWrongUsage);
    return failure.what();
  }
  return "";
}

}  // namespace disflow::apps
