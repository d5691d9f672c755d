// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "disflow/hal/fault.h"

/// @file
/// Values of options as people write them. Every error names the key and what is allowed.

namespace disflow::host {

/// One allowed word of an option and what it stands for.
template <class Value>
struct Choice {
  std::string_view word;
  Value value;
};

/// "a, b, c": the allowed words.
template <class Value>
[[nodiscard]] std::string ListChoices(std::span<const Choice<Value>> choices) {
  std::string list;
  for (const Choice<Value>& choice : choices) {
    if (!list.empty()) list += ", ";
    list += choice.word;
  }
  return list;
}

/// @param value Unchanged unless the result is ok.
template <class Value>
[[nodiscard]] hal::Fault ParseChoice(std::string_view key, std::string_view text,
                                     std::span<const Choice<Value>> choices, Value& value) {
  for (const Choice<Value>& choice : choices) {
    if (choice.word == text) {
      value = choice.value;
      return {};
    }
  }
  return hal::MakeFault(Status::kInvalidUri, "%.*s=%.*s is not known; allowed: %s",
                        static_cast<int>(key.size()), key.data(), static_cast<int>(text.size()),
                        text.data(), ListChoices(choices).c_str());
}

/// A number within [min, max]; a plus sign before it is allowed.
/// @param value Unchanged unless the result is ok.
template <class Number>
[[nodiscard]] hal::Fault ParseNumber(std::string_view key, std::string_view text, Number min,
                                     Number max, Number& value) {
  Number parsed{};
  const std::size_t plus = text.size() > 1 && text[0] == '+' && text[1] != '-' ? 1 : 0;
  const auto [end, error] = std::from_chars(text.data() + plus, text.data() + text.size(), parsed);
  // Written so that NaN fails.
  const bool in_range = parsed >= min && parsed <= max;
  if (error != std::errc{} || end != text.data() + text.size() || !in_range) {
    return hal::MakeFault(Status::kInvalidUri, "%.*s=%.*s is not a number from %.10g to %.10g",
                          static_cast<int>(key.size()), key.data(), static_cast<int>(text.size()),
                          text.data(), static_cast<double>(min), static_cast<double>(max));
  }
  value = parsed;
  return {};
}

}  // namespace disflow::host
