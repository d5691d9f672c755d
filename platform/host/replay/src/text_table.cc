// SPDX-License-Identifier: BSD-3-Clause
#include "text_table.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <system_error>

#include "disflow/host/regular_file.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSeparators = " \t\r,";

std::vector<std::string_view> SplitFields(std::string_view line) {
  std::vector<std::string_view> fields;
  line = line.substr(0, line.find('#'));
  std::size_t begin = line.find_first_not_of(kSeparators);
  while (begin != std::string_view::npos) {
    const std::size_t end = line.find_first_of(kSeparators, begin);
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSeparators, std::min(end, line.size()));
  }
  return fields;
}

}  // namespace

hal::Fault ReadTextFile(const fs::path& file, std::uintmax_t max_bytes, std::string& text) {
  if (const hal::Fault fault = CheckRegularFile(file); !fault.ok()) return fault;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) {
    const Status status =
        error == std::errc::no_such_file_or_directory ? Status::kNotFound : Status::kIoError;
    return hal::MakeFault(status, "%s: %s", file.c_str(), error.message().c_str());
  }
  if (size > max_bytes) {
    return hal::MakeFault(Status::kCorrupt, "%s: %ju bytes are too many; %ju can be read",
                          file.c_str(), size, max_bytes);
  }
  text.resize(static_cast<std::size_t>(size));
  std::ifstream stream(file, std::ios::binary);
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream) return {};
  return hal::MakeFault(Status::kIoError, "%s: cannot be read: %s", file.c_str(),
                        std::strerror(errno));
}

hal::Fault TextTable::Read(const fs::path& file) {
  file_ = file;
  rows_.clear();
  constexpr std::uintmax_t kMaxBytes = std::uintmax_t{1} << 26U;
  constexpr std::size_t kMaxRows = std::size_t{1} << 19U;
  constexpr std::size_t kMaxFields = 8 * kMaxRows;
  const hal::Fault fault = ReadTextFile(file, kMaxBytes, text_);
  if (!fault.ok()) return fault;
  std::string_view rest = text_;
  std::size_t fields = 0;
  for (int line = 1; !rest.empty(); ++line) {
    const std::string_view text = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(text.size() + 1, rest.size()));
    TableRow row{line, SplitFields(text)};
    fields += row.fields.size();
    if (fields > kMaxFields || rows_.size() == kMaxRows)
      return LineFault(row, "more than half a million lines, or four million fields, are too many");
    if (!row.fields.empty()) rows_.push_back(std::move(row));
  }
  return {};
}

hal::Fault TextTable::ParseNumbers(const TableRow& row, std::size_t count,
                                   std::vector<double>& numbers) const {
  numbers.clear();
  if (row.fields.size() < count) {
    return hal::MakeFault(Status::kCorrupt, "%s:%d: holds %zu numbers, %zu are needed",
                          file_.c_str(), row.line, row.fields.size(), count);
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::string_view field = row.fields[i];
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value)) {
      return hal::MakeFault(Status::kCorrupt, "%s:%d: '%.*s' is not a finite number", file_.c_str(),
                            row.line, static_cast<int>(std::min<std::size_t>(field.size(), 40)),
                            field.data());
    }
    numbers.push_back(value);
  }
  return {};
}

hal::Fault TextTable::LineFault(const TableRow& row, const char* problem) const {
  return hal::MakeFault(Status::kCorrupt, "%s:%d: %s", file_.c_str(), row.line, problem);
}

}  // namespace disflow::host
