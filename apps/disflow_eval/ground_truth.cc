// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth.h"

#include <cmath>
#include <set>
#include <string>

#include "disflow/host/bop_scene.h"
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

void RequireCount(const fs::path& file, std::size_t count, std::size_t expected) {
  if (count == expected) return;
  throw InputError(file, "holds " + std::to_string(count) + " frames, gt/poses.txt holds " +
                             std::to_string(expected));
}

std::vector<TruePose> LoadPoses(const fs::path& file) {
  std::vector<TruePose> poses;
  const std::string text = ReadFile(file);
  LineReader lines(text);
  for (Line line; lines.Next(line);) poses.push_back(ParsePose(file, line));
  if (poses.empty()) throw InputError(file, "holds no pose");
  return poses;
}

std::vector<PointTwist> LoadTwists(const fs::path& file) {
  std::vector<PointTwist> twists;
  const std::string text = ReadFile(file);
  LineReader lines(text);
  for (Line line; lines.Next(line);) {
    const std::vector<double> n = ParseNumbers(file, line, 6);
    twists.push_back({Vec3d(n[0], n[1], n[2]), Vec3d(n[3], n[4], n[5])});
  }
  return twists;
}

void LoadStamps(const fs::path& file, GroundTruth& truth) {
  const std::string text = ReadFile(file);
  LineReader lines(text);
  for (Line line; lines.Next(line);) {
    const std::vector<std::string_view> fields = SplitAtSpaces(line.text);
    if (fields.size() < 2) {
      throw InputError(file, line.number, "a frame index and a time stamp are needed");
    }
    truth.file_indices.push_back(ParseIndex(file, line, "index", fields[0]));
    truth.stamps_s.push_back(ParseFinite(file, line, "stamp", fields[1]));
  }
  RequireCount(file, truth.stamps_s.size(), truth.T_ct.size());
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
  truth.T_ct = LoadPoses(folder / "poses.txt");
  if (const fs::path file = folder / "velocities.txt"; fs::exists(file)) {
    truth.twists = LoadTwists(file);
    RequireCount(file, truth.twists.size(), truth.T_ct.size());
  }
  if (const fs::path file = sequence_dir / "data.txt"; fs::exists(file)) {
    LoadStamps(file, truth);
  } else {
    for (std::size_t i = 0; i < truth.T_ct.size(); ++i) {
      truth.file_indices.push_back(static_cast<int>(i));
    }
  }
  return truth;
}

}  // namespace disflow::apps
