// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace disflow::posix {

/// What a terminal can show of a text from outside: a question mark for each character that is not
/// plain ASCII.
/// @param most_bytes What is longer is cut, so that the rest of a message has room.
[[nodiscard]] inline std::string ShownText(std::string_view text, std::size_t most_bytes = 48) {
  std::string shown(text.substr(0, most_bytes));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return shown;
}

}  // namespace disflow::posix
