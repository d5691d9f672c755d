// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/numbered_files.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDigits = "0123456789";

/// Compares names so that runs of digits count as numbers.
bool NaturallyLess(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    const std::size_t digits_a = std::min(a.find_first_not_of(kDigits), a.size());
    const std::size_t digits_b = std::min(b.find_first_not_of(kDigits), b.size());
    if (digits_a == 0 || digits_b == 0) {
      if (a.front() != b.front()) return a.front() < b.front();
      a.remove_prefix(1);
      b.remove_prefix(1);
      continue;
    }
    std::string_view number_a = a.substr(0, digits_a);
    std::string_view number_b = b.substr(0, digits_b);
    number_a.remove_prefix(std::min(number_a.find_first_not_of('0'), number_a.size()));
    number_b.remove_prefix(std::min(number_b.find_first_not_of('0'), number_b.size()));
    if (number_a.size() != number_b.size()) return number_a.size() < number_b.size();
    if (number_a != number_b) return number_a < number_b;
    a.remove_prefix(digits_a);
    b.remove_prefix(digits_b);
  }
  return a.size() < b.size();
}

/// @return false if the name holds no number that can be used.
bool FindNumber(const std::string& stem, NumberedFile& file) {
  const std::size_t last = stem.find_last_of(kDigits);
  if (last == std::string::npos) return false;
  const std::size_t before = stem.find_last_not_of(kDigits, last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  file.prefix = stem.substr(0, first);
  return std::from_chars(stem.data() + first, stem.data() + last + 1, file.number).ec ==
         std::errc{};
}

}  // namespace

hal::Fault ListNumberedFiles(const fs::path& folder, const std::string& extension,
                             std::vector<NumberedFile>& files) {
  files.clear();
  std::error_code error;
  if (!fs::is_directory(folder, error)) return {};
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    NumberedFile file;
    file.path = entry->path();
    if (file.path.extension() == extension && FindNumber(file.path.stem().string(), file)) {
      files.push_back(std::move(file));
    }
  }
  if (error) {
    return hal::MakeFault(Status::kIoError, "%s: cannot be listed: %s", folder.c_str(),
                          error.message().c_str());
  }
  std::sort(files.begin(), files.end(), [](const NumberedFile& a, const NumberedFile& b) {
    return NaturallyLess(a.path.filename().native(), b.path.filename().native());
  });
  return {};
}

fs::path PathOfNumber(const std::vector<NumberedFile>& files, std::uint64_t number) {
  // The smallest number shows zeros ahead, if there are any.
  const NumberedFile& example = *std::min_element(
      files.begin(), files.end(),
      [](const NumberedFile& a, const NumberedFile& b) { return a.number < b.number; });
  const std::string name = example.path.filename().string();
  const std::size_t first = example.prefix.size();
  const std::size_t behind = std::min(name.find_first_not_of(kDigits, first), name.size());
  const bool has_zeros = behind - first > 1 && name[first] == '0';
  std::string digits = std::to_string(number);
  if (has_zeros && digits.size() < behind - first) {
    digits.insert(0, behind - first - digits.size(), '0');
  }
  return example.path.parent_path() / (example.prefix + digits + name.substr(behind));
}

}  // namespace disflow::host
