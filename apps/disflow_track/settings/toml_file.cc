// SPDX-License-Identifier: BSD-3-Clause
#include "settings/toml_file.h"

#include <algorithm>
#include <string_view>

#include "settings/settings_text.h"

namespace disflow::apps {
namespace {

/// Every dot of a key is a table in a table, which the parser builds and takes apart by recursion,
/// as deep as the key is long.
void RefuseDeepKeys(const std::string& file, std::string_view text) {
  constexpr std::ptrdiff_t kMostDots = 64;
  for (int line = 1; !text.empty(); ++line) {
    const std::string_view content = text.substr(0, text.find('\n'));
    if (std::count(content.begin(), content.end(), '.') > kMostDots)
      Refuse(file + ":" + std::to_string(line) + ": ", "a line with more than 64 dots");
    text.remove_prefix(std::min(content.size() + 1, text.size()));
  }
}

}  // namespace

toml::table ParseTomlFile(const std::string& file) {
  const std::string text = ReadSettingsText(file);
  RefuseDeepKeys(file, text);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    Refuse(line > 0 ? file + ":" + std::to_string(line) + ": " : file + ": ",
           std::string(error.description()));
  }
}

}  // namespace disflow::apps
