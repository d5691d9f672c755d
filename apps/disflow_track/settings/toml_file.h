// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <string>

#include "settings/refusal.h"

namespace disflow::apps {

/// @throws Failure kWrongUsage with file and line; also for a file that is far longer, or has keys
/// that are far deeper, than settings are.
[[nodiscard]] toml::table ParseTomlFile(const std::string& file);

/// "run.toml:12: ", for messages.
[[nodiscard]] inline std::string Where(const std::string& file, const toml::node& node) {
  return file + ":" + std::to_string(node.source().begin.line) + ": ";
}

}  // namespace disflow::apps
