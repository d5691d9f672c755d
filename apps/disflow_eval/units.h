// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <numbers>
#include <string>

namespace disflow::apps {

// Factors from SI units to those in which results are shown.
inline constexpr double kMillimetres = 1000.0;
inline constexpr double kCentimetres = 100.0;
inline constexpr double kDegrees = 180.0 / std::numbers::pi;
inline constexpr double kPercent = 100.0;

/// A printf-style text of any length.
template <class... Values>
[[nodiscard]] std::string Format(const char* format, Values... values) {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-security"
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  const int length = std::snprintf(nullptr, 0, format, values...);
  std::string text(static_cast<std::size_t>(length), '\0');
  (void)std::snprintf(text.data(), text.size() + 1, format, values...);
#pragma GCC diagnostic pop
  return text;
}

}  // namespace disflow::apps
