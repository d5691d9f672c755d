// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace disflow::apps {

/// For what was typed. An empty value would count as none, and the result that was asked for would
/// be missing without a word.
/// @throws CLI::ValidationError naming the option.
inline void RefuseEmptyValues(const CLI::App& app) {
  for (const CLI::Option* const option : app.get_options()) {
    for (const std::string& value : option->results()) {
      if (!value.empty()) continue;
      throw CLI::ValidationError(option->get_name(),
                                 "its value is empty; give one, or leave the option out (is a "
                                 "variable of the shell not set?)");
    }
  }
}

}  // namespace disflow::apps
