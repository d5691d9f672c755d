// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <string>

#include "program/exit_status.h"

namespace disflow::apps {

/// What somebody wrote cannot be used.
/// @param where Ahead of the text, e.g. "run.toml:12: ".
/// @throws Failure kWrongUsage.
[[noreturn]] inline void Refuse(const std::string& where, const std::string& text) {
  throw Failure(kWrongUsage, where + text);
}

/// A number as messages and pages show it: nine digits give every float back.
[[nodiscard]] inline std::string NumberText(double value) {
  char text[32];
  (void)std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

}  // namespace disflow::apps
