// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/mark.h>

#include <string>

namespace disflow::apps {

/// "params.yaml:12: ", for messages.
[[nodiscard]] inline std::string YamlPlace(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file + ": " : file + ":" + std::to_string(mark.line + 1) + ": ";
}

}  // namespace disflow::apps
