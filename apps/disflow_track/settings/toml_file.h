// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <toml++/toml.h>

#include <string>

#include "settings/refusal.h"

namespace disflow::apps {

/// @throws Failure kWrongUsage with file and line.
[[nodiscard]] inline toml::table ParseTomlFile(const std::string& file) {
  try {
    return toml::parse_file(file);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;  // 0 if the file cannot be opened
    Refuse(line > 0 ? file + ":" + std::to_string(line) + ": " : file + ": ",
           std::string(error.description()));
  }
}

/// "run.toml:12: ", for messages.
[[nodiscard]] inline std::string Where(const std::string& file, const toml::node& node) {
  return file + ":" + std::to_string(node.source().begin.line) + ": ";
}

}  // namespace disflow::apps
