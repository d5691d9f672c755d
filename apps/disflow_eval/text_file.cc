// SPDX-License-Identifier: BSD-3-Clause
#include "text_file.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iostream>

#include "disflow/host/file_output.h"
#include "disflow/host/regular_file.h"
#include "errors.h"
#include "output_path.h"

namespace disflow::apps {
namespace {

/// As much of a field as a message shows.
std::string Shown(std::string_view field) {
  constexpr std::size_t kMostShown = 40;
  return std::string(field.substr(0, kMostShown)) + (field.size() > kMostShown ? "…" : "");
}

constexpr std::string_view kSpaces = " \t\r";

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpaces);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpaces) - first + 1);
}

/// @param target Named in the error message.
void WriteDirectly(const std::filesystem::path& file, std::string_view text,
                   const std::filesystem::path& target) {
  errno = 0;
  std::ofstream stream(file, std::ios::binary | std::ios::trunc);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) {
    throw OutputError(target, std::string("cannot be written: ") + std::strerror(errno));
  }
}

/// Goes on where whoever started the program has written to: a log keeps what is in it.
/// @param target Named in the error message.
void WriteToDescriptor(int descriptor, std::string_view text, const std::filesystem::path& target) {
  std::cout.flush();  // What was said before stands before.
  if (!host::WriteAll(descriptor, text)) {
    throw OutputError(target, std::string("cannot be written: ") + std::strerror(errno));
  }
}

}  // namespace

std::string ReadFile(const std::filesystem::path& file, std::size_t max_bytes) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    throw InputError(file, "is a folder, a file is needed");
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file, std::string("cannot be opened: ") + std::strerror(errno));
  // Pipes have no size: they are read until they have said too much.
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::string text;
  if (!error && size <= max_bytes) text.reserve(static_cast<std::size_t>(size));
  std::array<char, 65536> part{};
  while (stream && text.size() <= max_bytes && (error || size <= max_bytes)) {
    stream.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) throw InputError(file, std::string("cannot be read: ") + std::strerror(errno));
  if (text.size() > max_bytes || (!error && size > max_bytes)) {
    throw InputError(file, "is longer than " + std::to_string(max_bytes) + " bytes");
  }
  return text;
}

std::string ReadRecordedFile(const std::filesystem::path& file, std::size_t max_bytes) {
  RequireRegularFile(file);
  return ReadFile(file, max_bytes);
}

void RequireRegularFile(const std::filesystem::path& file) {
  const hal::Fault fault = host::CheckRegularFile(file);
  if (!fault.ok()) throw InputError(fault.message);
}

void WriteFile(const std::filesystem::path& file, std::string_view text) {
  if (const auto descriptor = DescriptorOf(file)) {
    WriteToDescriptor(*descriptor, text, file);
    return;
  }
  std::error_code error;
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error)) {
    WriteDirectly(file, text, file);
    return;
  }
  const std::filesystem::path target = FollowLinks(file);
  std::filesystem::path partial = target;
  partial += ".partial-" + std::to_string(::getpid());
  try {
    WriteDirectly(partial, text, file);
  } catch (const OutputError&) {
    std::filesystem::remove(partial, error);
    throw;
  }
  std::filesystem::rename(partial, target, error);
  if (error) {
    const std::string reason = error.message();
    std::filesystem::remove(partial, error);
    throw OutputError(file, "cannot be replaced: " + reason);
  }
}

bool LineReader::Next(Line& line) {
  while (!rest_.empty()) {
    ++number_;
    const std::size_t end = rest_.find('\n');
    const std::string_view text = Trim(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (text.empty()) continue;
    line = {number_, text};
    return true;
  }
  return false;
}

std::vector<std::string_view> SplitAt(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = line.find(separator);
    fields.push_back(Trim(line.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    line.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> SplitAtSpaces(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    line = Trim(line);
    if (line.empty()) return fields;
    const std::size_t end = std::min(line.find_first_of(kSpaces), line.size());
    fields.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<double> ParseNumber(std::string_view field) {
  double value = 0.0;
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::vector<double> ParseNumbers(const std::filesystem::path& file, const Line& line,
                                 std::size_t count) {
  const std::vector<std::string_view> fields = SplitAtSpaces(line.text);
  if (fields.size() != count) {
    throw InputError(file, line.number,
                     "holds " + std::to_string(fields.size()) + " fields, " +
                         std::to_string(count) + " are needed");
  }
  std::vector<double> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(ParseFinite(file, line, std::to_string(i + 1), fields[i]));
  }
  return values;
}

double ParseFinite(const std::filesystem::path& file, const Line& line, std::string_view name,
                   std::string_view field) {
  const std::optional<double> value = ParseNumber(field);
  if (!value || !std::isfinite(*value)) {
    throw InputError(
        file, line.number,
        "field " + std::string(name) + " is '" + Shown(field) + "', a finite number is needed");
  }
  return *value;
}

int ParseIndex(const std::filesystem::path& file, const Line& line, std::string_view name,
               std::string_view field) {
  int value = 0;
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error != std::errc() || stop != end || value < 0) {
    throw InputError(file, line.number,
                     "field " + std::string(name) + " is '" + Shown(field) +
                         "', a whole number from 0 on is needed");
  }
  return value;
}

}  // namespace disflow::apps
