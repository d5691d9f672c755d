// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "disflow/host/bop_scene.h"
#include "disflow/host/recorded_stamp.h"
#include "errors.h"
#include "text_file.h"

namespace disflow::apps {
namespace {

namespace fs = std::filesystem;

/// Axes are printed with a few digits; anything farther from unit length is another format.
constexpr double kAxisTolerance = 0.01;

TruePose ParsePose(const fs::path& file, const Line& line) {
  const std::vector<double> n = ParseNumbers(file, line, 7);
  const Vec3d axis(n[3], n[4], n[5]);
  const double angle_rad = n[6];
  const double length = axis.norm();
  if (angle_rad != 0.0 && std::abs(length - 1.0) > kAxisTolerance) {
    throw InputError(file, line.number,
                     "rotation axis has length " + std::to_string(length) + ", 1 is needed");
  }
  const Vec3d theta = length > 0.0 ? Vec3d(angle_rad / length * axis) : Vec3d::Zero();
  return {ExpSo3(theta), Vec3d(n[0], n[1], n[2])};
}

PointTwist ParseTwist(const fs::path& file, const Line& line) {
  const std::vector<double> n = ParseNumbers(file, line, 6);
  return {Vec3d(n[0], n[1], n[2]), Vec3d(n[3], n[4], n[5])};
}

/// A line of data.txt, and the stamp in it.
std::string_view ParseFrame(const fs::path& file, const Line& line, GroundTruth& truth) {
  const std::vector<std::string_view> fields = SplitAtSpaces(line.text);
  if (fields.size() < 2) {
    throw InputError(file, line.number, "a frame index and a time stamp are needed");
  }
  truth.file_indices.push_back(ParseIndex(file, line, "index", fields[0]));
  truth.stamps_s.push_back(ParseFinite(file, line, "stamp", fields[1]));
  return fields[1];
}

void NoteCut(const fs::path& file, GroundTruth& truth) {
  truth.note +=
      (truth.note.empty() ? "the sequence was cut short; left out: the end of " : " and of ") +
      file.string();
}

void LoadStamps(const fs::path& file, GroundTruth& truth) {
  const std::string text = ReadRecordedFile(file);
  LineReader lines(text);
  std::optional<std::string_view> stamp;
  for (Line line; lines.Next(line);) {
    const bool may_be_cut = lines.at_end() && !text.ends_with('\n');
    if (may_be_cut && SplitAtSpaces(line.text).size() < 2 && stamp) return NoteCut(file, truth);
    const std::optional<std::string_view> before = stamp;
    stamp = ParseFrame(file, line, truth);
    if (!may_be_cut || !before || !host::IsCutStamp(*stamp, before)) continue;
    truth.file_indices.pop_back();
    truth.stamps_s.pop_back();
    NoteCut(file, truth);
  }
}

/// Reads the frames of a file that are known whole: one that was being written when the sequence
/// was cut short has no line in data.txt, and may be cut here.
/// @param frames Those that are known; empty: of as many as there are.
/// @param parse Takes the line of one.
template <class Parse>
void LoadFrames(const fs::path& file, std::optional<std::size_t> frames, GroundTruth& truth,
                Parse parse) {
  const std::string text = ReadRecordedFile(file);
  LineReader lines(text);
  std::size_t count = 0;
  for (Line line; lines.Next(line); ++count) {
    if (!frames || count < *frames) parse(line);
  }
  if (!frames || count == *frames) return;
  if (count == *frames + 1 && !truth.stamps_s.empty()) return NoteCut(file, truth);
  const char* const other = truth.stamps_s.empty() ? "gt/poses.txt" : "data.txt";
  throw InputError(
      file, "holds " + std::to_string(count) + " frames, " + other + " holds " +
                std::to_string(*frames) +
                "; a sequence that was cut short has at most one more than data.txt. If all are "
                "of one sequence, keep the first " +
                std::to_string(std::min(count, *frames)) +
                " lines of each, and those frames are evaluated");
}

/// Says which objects there are, if the one asked for is not.
void RequireObject(const fs::path& gt, const fs::path& folder) {
  if (fs::exists(folder / "poses.txt") || !fs::is_directory(gt)) return;
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(gt)) {
    if (fs::exists(entry.path() / "poses.txt")) names.insert(entry.path().filename().string());
  }
  if (names.empty()) return;
  std::string list;
  for (const std::string& name : names) list += " " + name;
  throw InputError(gt, "choose with --object one of:" + list);
}

}  // namespace

bool IsBopScene(const fs::path& dir) { return fs::exists(dir / "scene_camera.json"); }

GroundTruth LoadBopTruth(const fs::path& dir, const std::string& object, int& id) {
  host::BopCameras cameras;
  host::BopObjects objects;
  hal::Fault fault = ReadBopCameras(dir, cameras);
  if (fault.ok()) fault = ReadBopObjects(dir, objects);
  if (!fault.ok()) throw InputError(fault.message);
  const fs::path file = dir / "scene_gt.json";
  GroundTruth truth;
  for (const auto& [image, camera] : cameras) {
    const std::vector<host::BopObject>& shown = objects[image];
    int place = -1;
    fault = FindBopObject(shown, object, place);
    if (!fault.ok()) throw InputError(file, std::string("with --object, ") + fault.message);
    if (place < 0) {
      throw InputError(file, "image " + std::to_string(image) + " does not show the object '" +
                                 object + "' of --object");
    }
    const host::BopObject& found = shown[static_cast<std::size_t>(place)];
    id = found.id;
    truth.T_ct.emplace_back(found.T_co.rotation(), found.T_co.translation());
    truth.file_indices.push_back(static_cast<int>(image));
  }
  if (truth.T_ct.empty()) throw InputError(file, "holds no pose");
  return truth;
}

fs::path TruthFolder(const fs::path& sequence_dir, const std::string& object) {
  return object.empty() ? sequence_dir / "gt" : sequence_dir / "gt" / object;
}

GroundTruth LoadGroundTruth(const fs::path& sequence_dir, const std::string& object) {
  if (!fs::is_directory(sequence_dir)) {
    throw InputError(sequence_dir, "is no folder; a sequence in the Fast-YCB layout is needed");
  }
  const fs::path folder = TruthFolder(sequence_dir, object);
  RequireObject(sequence_dir / "gt", folder);
  GroundTruth truth;
  std::optional<std::size_t> frames;
  if (const fs::path file = sequence_dir / "data.txt"; fs::exists(file)) {
    LoadStamps(file, truth);
    frames = truth.stamps_s.size();
    if (*frames == 0) {
      throw InputError(file,
                       "lists no frame; a sequence that was cut short before its first frame was "
                       "complete has to be made anew");
    }
  }
  const fs::path poses = folder / "poses.txt";
  LoadFrames(poses, frames, truth,
             [&](const Line& line) { truth.T_ct.push_back(ParsePose(poses, line)); });
  if (truth.T_ct.empty()) throw InputError(poses, "holds no pose");
  if (const fs::path file = folder / "velocities.txt"; fs::exists(file)) {
    LoadFrames(file, truth.T_ct.size(), truth,
               [&](const Line& line) { truth.twists.push_back(ParseTwist(file, line)); });
  }
  if (frames) return truth;
  for (std::size_t i = 0; i < truth.T_ct.size(); ++i)
    truth.file_indices.push_back(static_cast<int>(i));
  return truth;
}

}  // namespace disflow::apps
