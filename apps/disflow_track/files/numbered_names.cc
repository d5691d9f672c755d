// SPDX-License-Identifier: BSD-3-Clause
#include "files/numbered_names.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "disflow/host/sequence_writer.h"
#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

/// Files sort by number up to a million starts; more digits follow then.
constexpr std::size_t kDigits = 6;
/// More is no number that this program wrote.
constexpr std::size_t kMostDigits = 12;

/// An output's name, taken apart at the number.
struct NumberedName {
  fs::path folder;
  std::string before;
  std::string after;
};

[[noreturn]] void Refuse(const std::string& name) {
  throw Failure(kWrongUsage, name + ": " + kRunNumber +
                                 " may stand once in a name, in its last part: "
                                 "/var/lib/disflow/run-{n}.csv");
}

NumberedName TakeApart(const std::string& name) {
  fs::path path(name);
  if (!path.has_filename()) path = path.parent_path();  // "flow-{n}/"
  const std::string last = path.filename();
  const std::string_view number = kRunNumber;
  const std::size_t place = last.find(number);
  const bool is_elsewhere = name.find(number) != name.rfind(number);
  if (place == std::string::npos || is_elsewhere) Refuse(name);
  return {path.parent_path(), last.substr(0, place), last.substr(place + number.size())};
}

/// @return The number in the name of a file that is there, 0 if it is none of these.
std::int64_t NumberIn(std::string_view file, const NumberedName& name) {
  if (!file.starts_with(name.before)) return 0;
  file.remove_prefix(name.before.size());
  std::int64_t number = 0;
  const char* const begin = file.data();
  const auto [end, error] =
      std::from_chars(begin, begin + std::min(file.size(), kMostDigits), number);
  const auto digits = static_cast<std::size_t>(end - begin);
  if (error != std::errc() || digits < kDigits || number < 0) return 0;
  // What a run leaves behind that is killed while it writes a mesh counts as well.
  file.remove_prefix(digits);
  const bool goes_on = !file.empty() && file.front() >= '0' && file.front() <= '9';
  return !goes_on && file.starts_with(name.after) ? number : 0;
}

/// Calls visit(path, number) for all that has such a name.
template <class Visitor>
void VisitNumbered(const NumberedName& name, Visitor&& visit) {
  const fs::path folder = name.folder.empty() ? fs::path(".") : name.folder;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  // One that is not there will be made, or opening the file says that it is not.
  if (error == std::errc::no_such_file_or_directory) return;
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    visit(entry->path(), NumberIn(entry->path().filename().string(), name));
  if (error) {
    throw Failure(kOutputFailed, folder.string() + ": cannot be read: " + error.message() +
                                     "; the numbers that are taken are looked up there");
  }
}

std::string Padded(std::int64_t number) {
  const std::string digits = std::to_string(number);
  return std::string(kDigits - std::min(kDigits, digits.size()), '0') + digits;
}

std::int64_t HighestNumber(const NumberedName& name) {
  std::int64_t highest = 0;
  VisitNumbered(name, [&highest](const fs::path&, std::int64_t number) {
    highest = std::max(highest, number);
  });
  return highest;
}

void RemoveOutput(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(fs::symlink_status(path, error))) {
    if (host::HoldsSequence(path)) Require(host::RemoveSequence(path));
    if (!fs::is_empty(path, error) && !error) return;
  }
  (void)fs::remove(path, error);
  if (error)
    throw Failure(kOutputFailed, path.string() + ": cannot be removed: " + error.message());
}

/// Those that hold the place of a number.
std::vector<std::string*> NumberedOutputs(Options& options) {
  std::vector<std::string*> names{&options.record};
  for (ObjectOptions& object : options.objects) {
    ObjectFiles& files = object.files;
    names.insert(names.end(), {&files.csv, &files.mesh, &files.mesh_picture, &files.flow});
  }
  std::erase_if(
      names, [](const std::string* name) { return name->find(kRunNumber) == std::string::npos; });
  return names;
}

}  // namespace

Options NumberOutputs(Options options) {
  const std::vector<std::string*> names = NumberedOutputs(options);
  std::int64_t highest = 0;
  for (const std::string* const name : names)
    highest = std::max(highest, HighestNumber(TakeApart(*name)));
  for (std::string* const name : names) {
    const NumberedName parts = TakeApart(*name);
    *name = parts.folder / (parts.before + Padded(highest + 1) + parts.after);
  }
  return options;
}

void RemoveOldOutputs(const Options& options, int keep) {
  std::vector<std::string> names{options.record};
  for (const ObjectOptions& object : options.objects) names.push_back(object.files.csv);
  std::erase_if(names,
                [](const std::string& name) { return name.find(kRunNumber) == std::string::npos; });
  std::set<std::int64_t> numbers;
  for (const std::string& name : names) {
    VisitNumbered(TakeApart(name), [&numbers](const fs::path&, std::int64_t number) {
      if (number > 0) numbers.insert(number);
    });
  }
  if (numbers.size() <= static_cast<std::size_t>(keep)) return;
  const std::int64_t oldest_kept = *std::next(numbers.rbegin(), keep - 1);
  for (const std::string& name : names) {
    const NumberedName parts = TakeApart(name);
    std::vector<fs::path> old;
    VisitNumbered(parts, [&](const fs::path& path, std::int64_t number) {
      if (number > 0 && number < oldest_kept &&
          path.filename() == parts.before + Padded(number) + parts.after)
        old.push_back(path);
    });
    for (const fs::path& path : old) RemoveOutput(path);
  }
}

}  // namespace disflow::apps
