// SPDX-License-Identifier: BSD-3-Clause
#include "sequence_index.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string>
#include <system_error>

#include "cut_recording.h"
#include "disflow/host/sequence_layout.h"
#include "numbered_files.h"
#include "text_table.h"
#include "world_poses.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

constexpr StampNs kNsPerS = 1'000'000'000;

/// Decimal seconds to nanoseconds without a detour through double.
bool ParseStamp(std::string_view text, StampNs& stamp_ns) {
  const char* const end = text.data() + text.size();
  std::int64_t seconds = 0;
  auto [next, error] = std::from_chars(text.data(), end, seconds);
  constexpr std::int64_t kMaxSeconds = 9'000'000'000;
  if (error != std::errc{} || seconds < 0 || seconds > kMaxSeconds) return false;
  stamp_ns = seconds * kNsPerS;
  if (next == end) return true;
  if (*next != '.') return false;
  StampNs unit_ns = kNsPerS;
  for (++next; next != end; ++next) {
    if (*next < '0' || *next > '9') return false;
    unit_ns /= 10;
    stamp_ns += unit_ns * (*next - '0');
  }
  return true;
}

bool ParseIndex(std::string_view text, std::uint64_t& index) {
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, index);
  return error == std::errc{} && next == end;
}

/// Images that lie in the folder itself. Colour and depth side by side differ in their names.
hal::Fault ListLooseImages(const fs::path& dir, std::vector<NumberedFile>& files) {
  const hal::Fault fault = ListNumberedFiles(dir, kImageExtension, files);
  if (!fault.ok() || files.empty()) return fault;
  for (const NumberedFile& file : files) {
    if (file.prefix == files.front().prefix) continue;
    return hal::MakeFault(Status::kUnsupported,
                          "%s: holds images of several kinds, '%s*' and '%s*'; put the depth "
                          "images into a folder depth",
                          dir.c_str(), files.front().prefix.c_str(), file.prefix.c_str());
  }
  return {};
}

hal::Fault ListDepth(const fs::path& dir, SequenceIndex& index, std::vector<NumberedFile>& files) {
  hal::Fault fault = ListNumberedFiles(dir / kDepthFolder, kDepthExtension, files);
  index.float_depth = !files.empty();
  for (const char* folder : {kDepthFolder, kMaskedDepthFolder}) {
    if (!fault.ok() || !files.empty()) return fault;
    fault = ListNumberedFiles(dir / folder, kImageExtension, files);
  }
  if (fault.ok() && files.empty()) fault = ListLooseImages(dir, files);
  if (!fault.ok() || !files.empty()) return fault;
  return hal::MakeFault(Status::kNotFound,
                        "%s: holds no depth/*.float, depth/*.png, masked_depth/*.png or *.png",
                        dir.c_str());
}

/// The images that are there, at the usual rate.
void ListByFiles(const std::vector<NumberedFile>& files, std::vector<RecordedFrame>& frames) {
  constexpr StampNs kUsualRate_hz = 30;
  for (const NumberedFile& file : files) {
    RecordedFrame& frame = frames.emplace_back();
    frame.number = file.number;
    frame.depth = file.path.string();
    // From one second on: a stamp of zero means "not set" to some programs.
    const auto k = static_cast<StampNs>(frames.size() - 1);
    frame.stamp_ns = kNsPerS + k * kNsPerS / kUsualRate_hz;
  }
}

bool ParseLine(const TableRow& row, RecordedFrame& frame) {
  return row.fields.size() >= 2 && ParseIndex(row.fields[0], frame.number) &&
         ParseStamp(row.fields[1], frame.stamp_ns);
}

/// One frame per line of data.txt. An image that is listed and not there is a frame all the same,
/// so that its loss is seen when it is read.
hal::Fault ListByStamps(const fs::path& path, const std::vector<NumberedFile>& files,
                        SequenceIndex& index) {
  TextTable table;
  const hal::Fault fault = table.Read(path);
  if (!fault.ok()) return fault;
  std::map<std::uint64_t, const NumberedFile*> missing_line;
  for (const NumberedFile& file : files) missing_line[file.number] = &file;
  const bool is_cut = EndsWithinItsLastLine(table);
  for (const TableRow& row : table.rows()) {
    if (is_cut && &row == &table.rows().back()) break;
    RecordedFrame& frame = index.frames.emplace_back();
    if (!ParseLine(row, frame))
      return table.LineFault(row, "an image number and a stamp in seconds are needed");
    const auto found = missing_line.find(frame.number);
    if (found != missing_line.end()) {
      frame.depth = found->second->path.string();
      missing_line.erase(found);
    } else {
      const NumberedFile& example = files.front();
      frame.depth = (example.path.parent_path() / (example.prefix + std::to_string(frame.number) +
                                                   example.path.extension().string()))
                        .string();
    }
  }
  std::vector<NumberedFile> unlisted;
  for (const auto& [number, file] : missing_line) unlisted.push_back(*file);
  if (unlisted.empty() && is_cut) LeaveOut(path.string() + " ends within a line", index);
  return LeaveOutUnlisted(path, unlisted, index);
}

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

std::vector<std::string> SplitNames(const std::string& names) {
  std::vector<std::string> list;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find('+', begin), names.size());
    list.push_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  return list;
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
  constexpr std::size_t kMostLabels = 255;
  if (prefixes.size() > kMostLabels) {
    return hal::MakeFault(Status::kInvalidUri, "object= names %zu objects; a mask has %zu labels",
                          prefixes.size(), kMostLabels);
  }
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

hal::Fault TakeRange(const ReplayOptions& options, std::vector<RecordedFrame>& frames) {
  if (static_cast<std::size_t>(options.first) >= frames.size()) {
    return hal::MakeFault(Status::kInvalidUri, "first=%d, but %s has only %zu images",
                          options.first, options.dir.c_str(), frames.size());
  }
  frames.erase(frames.begin(), frames.begin() + options.first);
  if (static_cast<std::size_t>(options.count) < frames.size()) {
    frames.resize(static_cast<std::size_t>(options.count));
  }
  return {};
}

}  // namespace

hal::Fault IndexSequence(const ReplayOptions& options, SequenceIndex& index) {
  index = {};
  std::error_code error;
  if (!fs::is_directory(options.dir, error)) {
    return hal::MakeFault(Status::kNotFound, "%s: is no folder; a recorded sequence is needed",
                          options.dir.c_str());
  }
  std::vector<NumberedFile> files;
  hal::Fault fault = ListDepth(options.dir, index, files);
  if (fault.ok() && options.camera) {
    index.camera.camera = *options.camera;
  } else if (fault.ok()) {
    fault = ReadCamera(options.dir, index.camera);
  }
  if (fault.ok() && index.float_depth && options.unit_m) {
    fault = hal::MakeFault(Status::kInvalidUri, "%s: scale is for 16-bit images; .float is metres",
                           options.dir.c_str());
  }
  if (fault.ok() && fs::exists(options.dir / kDataFile)) {
    fault = ListByStamps(options.dir / kDataFile, files, index);
  } else if (fault.ok()) {
    ListByFiles(files, index.frames);
  }
  if (fault.ok() && index.float_depth) LeaveOutCutDepth(index);
  if (fault.ok() && index.cut_frames > 0) {
    index.cut_note = options.dir.string() + ": the recording was cut short and ends with frame " +
                     std::to_string(index.frames.back().number) + "; left out: " + index.cut_note;
  }
  if (fault.ok()) fault = FindMasks(options, index);
  if (fault.ok()) fault = ReadWorldPoses(options, index);
  if (fault.ok()) fault = TakeRange(options, index.frames);
  return fault;
}

}  // namespace disflow::host
