// SPDX-License-Identifier: BSD-3-Clause
#include "sequence_index.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <system_error>

#include "bop_sequence.h"
#include "cut_recording.h"
#include "disflow/host/numbered_files.h"
#include "disflow/host/sequence_layout.h"
#include "recorded_masks.h"
#include "stamp_text.h"
#include "text_table.h"
#include "tum_sequence.h"
#include "world_poses.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

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

/// The images that are there, at the given rate.
void ListByFiles(const std::vector<NumberedFile>& files, double rate_hz,
                 std::vector<RecordedFrame>& frames) {
  for (const NumberedFile& file : files) {
    RecordedFrame& frame = frames.emplace_back();
    frame.number = file.number;
    frame.depth = file.path.string();
    frame.stamp_ns = StampAtRate(frames.size() - 1, rate_hz);
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
      frame.depth = PathOfNumber(files, frame.number).string();
    }
  }
  std::vector<NumberedFile> unlisted;
  unlisted.reserve(missing_line.size());
  for (const auto& [number, file] : missing_line) unlisted.push_back(*file);
  if (unlisted.empty() && is_cut) LeaveOut(path.string() + " ends within a line", index);
  return LeaveOutUnlisted(path, unlisted, index);
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

/// A folder of images with data.txt or, if the rate is given, without.
hal::Fault ListImages(const ReplayOptions& options, SequenceIndex& index) {
  std::vector<NumberedFile> files;
  hal::Fault fault = ListDepth(options.dir, index, files);
  if (fault.ok() && !options.camera) fault = ReadCamera(options.dir, index.camera);
  if (!fault.ok()) return fault;
  if (index.float_depth && options.unit_m) {
    return hal::MakeFault(Status::kInvalidUri, "%s: scale is for 16-bit images; .float is metres",
                          options.dir.c_str());
  }
  if (fs::exists(options.dir / kDataFile)) {
    fault = CheckRate(options, kDataFile);
    if (fault.ok()) fault = ListByStamps(options.dir / kDataFile, files, index);
  } else {
    fault = CheckRate(options, nullptr);
    if (fault.ok()) ListByFiles(files, *options.rate_hz, index.frames);
  }
  if (fault.ok() && index.float_depth) LeaveOutCutDepth(index);
  if (fault.ok() && index.cut_frames > 0) {
    index.cut_note = options.dir.string() + ": the recording was cut short and ends with frame " +
                     std::to_string(index.frames.back().number) + "; left out: " + index.cut_note;
  }
  return fault;
}

/// Whatever layout it is, each tells itself by a file that the others do not have.
hal::Fault ListFrames(const ReplayOptions& options, SequenceIndex& index) {
  hal::Fault fault;
  if (fs::exists(options.dir / kBopCameraFile)) {
    fault = ListBopSequence(options, index);
  } else if (fs::exists(options.dir / kTumDepthFile)) {
    fault = ListTumSequence(options, index);
  } else {
    fault = ListImages(options, index);
  }
  if (fault.ok() && index.layout != SequenceLayout::kBop) fault = FindMasks(options, index);
  return fault;
}

}  // namespace

StampNs StampAtRate(std::uint64_t k, double rate_hz) {
  constexpr double kNsPerS = 1e9;
  // From one second on: a stamp of zero means "not set" to some programs.
  return static_cast<StampNs>(kNsPerS) + std::llround(static_cast<double>(k) * (kNsPerS / rate_hz));
}

hal::Fault CheckRate(const ReplayOptions& options, const char* stamps) {
  if (stamps == nullptr && !options.rate_hz) {
    return hal::MakeFault(Status::kInvalidUri,
                          "%s: its images have no stamps, and without them no speed is right; add "
                          "?fps=30 if 30 were taken per second",
                          options.dir.c_str());
  }
  if (stamps != nullptr && options.rate_hz) {
    return hal::MakeFault(Status::kInvalidUri,
                          "%s: fps is for images without stamps; its are in %s",
                          options.dir.c_str(), stamps);
  }
  return {};
}

hal::Fault IndexSequence(const ReplayOptions& options, SequenceIndex& index) {
  index = {};
  std::error_code error;
  if (!fs::is_directory(options.dir, error)) {
    const bool is_file = fs::is_regular_file(options.dir, error);
    return hal::MakeFault(Status::kNotFound, "%s: is no folder; a recorded sequence is needed%s",
                          options.dir.c_str(),
                          is_file ? " (files that ROS recorded are rosbag:FILE?depth=TOPIC)" : "");
  }
  hal::Fault fault = ListFrames(options, index);
  if (options.camera) index.camera.camera = *options.camera;
  if (fault.ok()) fault = ReadWorldPoses(options, index);
  if (fault.ok()) fault = TakeRange(options, index.frames);
  return fault;
}

}  // namespace disflow::host
