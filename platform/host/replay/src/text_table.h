// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// The fields of one line of a text file.
struct TableRow {
  int line = 0;  ///< Counted from 1.
  std::vector<std::string_view> fields;
};

/// A text file taken apart at white space and commas; empty lines and # comments are left out.
class TextTable {
 public:
  TextTable() = default;
  TextTable(const TextTable&) = delete;
  TextTable& operator=(const TextTable&) = delete;

  /// @return kNotFound, kCorrupt (absurdly large: there is room for hours) or kIoError, naming the
  /// file.
  [[nodiscard]] hal::Fault Read(const std::filesystem::path& file);
  [[nodiscard]] const std::vector<TableRow>& rows() const { return rows_; }
  /// Whether the last line has its line feed. Without, it may have been cut.
  [[nodiscard]] bool ends_with_line_feed() const { return text_.ends_with('\n'); }

  /// The first `count` fields of a row as finite numbers.
  [[nodiscard]] hal::Fault ParseNumbers(const TableRow& row, std::size_t count,
                                        std::vector<double>& numbers) const;
  /// A fault about one line of the file.
  [[nodiscard]] hal::Fault LineFault(const TableRow& row, const char* problem) const;

 private:
  std::filesystem::path file_;
  std::string text_;
  std::vector<TableRow> rows_;
};

/// The whole of a small text file.
/// @return kNotFound, kCorrupt (more than `max_bytes` long, which is found out before it is read)
/// or kIoError, naming the file.
[[nodiscard]] hal::Fault ReadTextFile(const std::filesystem::path& file, std::uintmax_t max_bytes,
                                      std::string& text);

}  // namespace disflow::host
