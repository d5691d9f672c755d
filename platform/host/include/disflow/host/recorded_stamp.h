// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace disflow::host {

/// Whether the stamp at the end of a data.txt that has no last line feed was not written to its
/// end. Others may leave out that line feed, but a recording's stamps have nine decimals each: one
/// with fewer would be a wrong time.
/// @param before The stamp of the line before, if there is one.
[[nodiscard]] inline bool IsCutStamp(std::string_view stamp,
                                     std::optional<std::string_view> before) {
  constexpr std::size_t kRecordedDecimals = 9;
  const auto decimals = [](std::string_view text) {
    const std::size_t point = text.find('.');
    return point == std::string_view::npos ? 0 : text.size() - point - 1;
  };
  const bool is_recorded = !before || decimals(*before) == kRecordedDecimals;
  return is_recorded && decimals(stamp) < kRecordedDecimals;
}

}  // namespace disflow::host
