// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace disflow::test {

/// Fields of a datagram to systemd's journal, read as systemd.io/JOURNAL_NATIVE_PROTOCOL says:
/// NAME=value and a line break, or NAME, a line break, 64 bits of length (little endian), the value
/// and a line break.
/// @return Nothing if it is not of that form; journald would throw it away.
[[nodiscard]] inline std::optional<std::map<std::string, std::string>> ReadJournalEntry(
    std::string_view datagram) {
  std::map<std::string, std::string> fields;
  while (!datagram.empty()) {
    const std::size_t line_end = datagram.find('\n');
    if (line_end == std::string_view::npos) return std::nullopt;
    const std::string_view line = datagram.substr(0, line_end);
    const std::size_t equals = line.find('=');
    const std::string name(line.substr(0, equals));
    const bool is_name =
        !name.empty() && name[0] >= 'A' && name[0] <= 'Z' &&
        name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == std::string::npos;
    if (!is_name) return std::nullopt;
    datagram.remove_prefix(line_end + 1);
    if (equals != std::string_view::npos) {
      fields[name] = line.substr(equals + 1);
      continue;
    }
    std::uint64_t length = 0;
    if (datagram.size() < sizeof(length)) return std::nullopt;
    for (std::size_t i = 0; i < sizeof(length); ++i)
      length |= std::uint64_t{static_cast<unsigned char>(datagram[i])} << (8 * i);
    datagram.remove_prefix(sizeof(length));
    if (datagram.size() <= length) return std::nullopt;
    const auto end = static_cast<std::size_t>(length);
    if (datagram[end] != '\n') return std::nullopt;
    fields[name] = datagram.substr(0, end);
    datagram.remove_prefix(end + 1);
  }
  return fields;
}

}  // namespace disflow::test
