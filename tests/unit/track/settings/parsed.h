// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "settings/options.h"

namespace disflow::apps {

/// What the program makes of a command line without its own name.
[[nodiscard]] inline Options Parsed(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "disflow_track");
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  bool exit_now = false;
  Options options = ParseCommandLine(static_cast<int>(pointers.size()), pointers.data(), exit_now);
  EXPECT_FALSE(exit_now);
  return options;
}

}  // namespace disflow::apps
