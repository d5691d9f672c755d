// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <type_traits>

namespace disflow::apps {

/// One of several words, for an option whose variable is an enumeration.
template <class Value>
[[nodiscard]] CLI::Validator Choice(const std::map<std::string, Value>& choices) {
  return CLI::Validator(
      [choices](std::string& word) -> std::string {
        const auto found = choices.find(word);
        if (found != choices.end()) {
          // As numbers the parser writes words into enumerations.
          word = std::to_string(static_cast<std::underlying_type_t<Value>>(found->second));
          return {};
        }
        std::string message = "'" + word + "' is none of ";
        for (auto choice = choices.begin(); choice != choices.end(); ++choice)
          message += (choice == choices.begin() ? "" : ", ") + choice->first;
        return message;
      },
      "", "choice");
}

}  // namespace disflow::apps
