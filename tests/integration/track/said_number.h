// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace disflow::test {

/// The number before `words` in a report; -1 if they are not there.
[[nodiscard]] inline int NumberBefore(const std::string& text, const std::string& words) {
  const std::size_t end = text.find(" " + words);
  if (end == std::string::npos) return -1;
  const std::size_t begin = text.find_last_not_of("0123456789", end - 1) + 1;
  return std::stoi(text.substr(begin, end - begin));
}

}  // namespace disflow::test
