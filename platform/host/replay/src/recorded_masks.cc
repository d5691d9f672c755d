// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_masks.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <system_error>

#include "disflow/host/numbered_files.h"
#include "disflow/host/sequence_layout.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

std::string ListMaskSets(const fs::path& masks) {
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(masks, error), end; !error && entry != end;
       entry.increment(error)) {
    names.insert(entry->path().filename().string());
  }
  std::string list;
  for (const std::string& name : names) list += name + ", ";
  return list + "none";
}

/// The objects whose masks are used: those asked for, or the only one.
hal::Fault ChooseObjects(const fs::path& folder, const std::vector<NumberedFile>& files,
                         const std::string& wanted, std::vector<std::string>& chosen) {
  std::set<std::string> prefixes;
  for (const NumberedFile& file : files) prefixes.insert(file.prefix);
  if (wanted.empty()) {
    chosen = {*prefixes.begin()};
    if (prefixes.size() == 1) return {};
  } else {
    chosen.clear();
    // A name with a + in it is one name, if there is such a one.
    const bool is_one = prefixes.contains(wanted + "_");
    for (const std::string& name : is_one ? std::vector{wanted} : SplitNames(wanted))
      chosen.push_back(name + "_");
    if (std::all_of(chosen.begin(), chosen.end(),
                    [&](const std::string& prefix) { return prefixes.contains(prefix); })) {
      return {};
    }
  }
  std::string list;
  for (const std::string& name : prefixes) list.append(" ").append(name, 0, name.rfind('_'));
  return hal::MakeFault(Status::kNotFound,
                        "%s: choose with object=NAME, or several joined by +, of:%s",
                        folder.c_str(), list.c_str());
}

/// Whether there is a file of a frame. With a recording that was cut short there may be none: its
/// first mask was that of the frame that is left out.
bool AnyOfFrames(const std::vector<NumberedFile>& files, const SequenceIndex& index) {
  if (index.cut_frames == 0) return true;
  std::set<std::uint64_t> numbers;
  for (const RecordedFrame& frame : index.frames) numbers.insert(frame.number);
  return std::any_of(files.begin(), files.end(), [&numbers](const NumberedFile& file) {
    return numbers.contains(file.number);
  });
}

}  // namespace

std::vector<std::string> SplitNames(const std::string& names) {
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find('+', begin), names.size());
    list.push_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
}

hal::Fault TooManyObjects(std::size_t count) {
  return hal::MakeFault(Status::kInvalidUri, "object= names %zu objects; a mask has %zu labels",
                        count, kMostLabels);
}

hal::Fault FindMasks(const ReplayOptions& options, SequenceIndex& index) {
  const fs::path masks = options.dir / kMaskFolder;
  const fs::path folder = masks / (options.mask_set.empty() ? "gt" : options.mask_set);
  if (options.mask_set == "none" || (options.mask_set.empty() && !fs::exists(folder))) return {};
  std::vector<NumberedFile> files;
  hal::Fault fault = ListNumberedFiles(folder, kImageExtension, files);
  if (!fault.ok()) return fault;
  if (options.mask_set.empty() && !AnyOfFrames(files, index)) return {};
  if (files.empty()) {
    return hal::MakeFault(Status::kNotFound, "%s: holds no masks; available: %s", folder.c_str(),
                          ListMaskSets(masks).c_str());
  }
  std::vector<std::string> prefixes;
  fault = ChooseObjects(folder, files, options.object, prefixes);
  if (!fault.ok()) return fault;
  if (prefixes.size() > kMostLabels) return TooManyObjects(prefixes.size());
  for (const std::string& prefix : prefixes) {
    std::map<std::uint64_t, fs::path> by_number;
    for (const NumberedFile& file : files) {
      if (file.prefix == prefix) by_number[file.number] = file.path;
    }
    for (RecordedFrame& frame : index.frames) {
      const auto found = by_number.find(frame.number);
      frame.masks.push_back(found != by_number.end() ? found->second : fs::path());
    }
  }
  index.masked_objects = static_cast<int>(prefixes.size());
  return {};
}

}  // namespace disflow::host
