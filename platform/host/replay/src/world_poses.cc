// SPDX-License-Identifier: BSD-3-Clause
#include "world_poses.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "disflow/host/numbered_files.h"
#include "disflow/host/rigid_state.h"
#include "disflow/host/sequence_layout.h"
#include "text_table.h"
#include "tum_sequence.h"

namespace disflow::host {
namespace {

namespace fs = std::filesystem;

hal::Fault CountFault(const fs::path& path, std::size_t count, std::size_t images) {
  return hal::MakeFault(Status::kCorrupt,
                        "%s: has %zu entries for %zu depth images; one per image "
                        "is needed",
                        path.c_str(), count, images);
}

/// The first frame that has a pose is recorded with a line for each before it. A recording that was
/// cut short within these has no pose to lose.
bool IsCutBeforeItsFirstPose(const TextTable& table, const SequenceIndex& index) {
  const std::vector<TableRow>& rows = table.rows();
  return index.cut_frames > 0 && rows.size() <= index.frames.size() &&
         std::all_of(rows.begin(), rows.end(), [](const TableRow& row) {
           return row.fields.size() == 1 &&
                  std::string_view(kNoWorldPose).starts_with(row.fields[0]);
         });
}

/// `x y z nx ny nz theta` per line, or kNoWorldPose.
hal::Fault ReadAxisAnglePoses(const fs::path& file, SequenceIndex& index) {
  std::vector<RecordedFrame>& frames = index.frames;
  TextTable table;
  hal::Fault fault = table.Read(file);
  if (!fault.ok() || IsCutBeforeItsFirstPose(table, index)) return fault;
  // Frames that were cut short may have theirs already.
  if (table.rows().size() < frames.size() ||
      table.rows().size() > frames.size() + index.cut_frames) {
    return CountFault(file, table.rows().size(), frames.size());
  }
  std::vector<double> n;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const TableRow& row = table.rows()[i];
    if (row.fields.size() == 1 && row.fields[0] == kNoWorldPose) continue;
    fault = table.ParseNumbers(row, 7, n);
    if (!fault.ok()) return fault;
    const Vec3d axis(n[3], n[4], n[5]);
    constexpr double kTolerance = 0.01;
    if (std::abs(axis.norm() - 1.0) > kTolerance) {
      return table.LineFault(row, "the rotation axis is not of unit length");
    }
    const Transform<World, Camera, double> pose(ExpSo3(Vec3d(axis.normalized() * n[6])),
                                                Vec3d(n[0], n[1], n[2]));
    frames[i].T_wc = pose.Cast<float>();
    frames[i].has_T_wc = true;
  }
  return {};
}

hal::Fault ReadMatrixPose(const fs::path& file, Transform<World, Camera>& pose) {
  TextTable table;
  hal::Fault fault = table.Read(file);
  if (!fault.ok()) return fault;
  const Status kBad = Status::kCorrupt;
  if (table.rows().size() < 3) {
    return hal::MakeFault(kBad, "%s: holds %zu lines; a 4x4 matrix is needed", file.c_str(),
                          table.rows().size());
  }
  Mat3d rotation;
  Vec3d translation;
  std::vector<double> n;
  for (int row = 0; row < 3; ++row) {
    fault = table.ParseNumbers(table.rows()[static_cast<std::size_t>(row)], 4, n);
    if (!fault.ok()) return fault;
    rotation.row(row) << n[0], n[1], n[2];
    translation[row] = n[3];
  }
  if (!IsRotation(rotation)) {
    return hal::MakeFault(Status::kInvalidTransform, "%s: its 3x3 part is no rotation",
                          file.c_str());
  }
  pose = Transform<World, Camera, double>(rotation, translation).Normalized().Cast<float>();
  return {};
}

hal::Fault ReadPoseFolder(const fs::path& dir, std::vector<RecordedFrame>& frames) {
  const fs::path folder = dir / kPoseFolder;
  std::vector<NumberedFile> files;
  hal::Fault fault = ListNumberedFiles(folder, ".txt", files);
  if (!fault.ok()) return fault;
  if (files.size() != frames.size()) return CountFault(folder, files.size(), frames.size());
  for (std::size_t i = 0; i < frames.size() && fault.ok(); ++i) {
    fault = ReadMatrixPose(files[i].path, frames[i].T_wc);
    frames[i].has_T_wc = true;
  }
  return fault;
}

}  // namespace

hal::Fault ReadWorldPoses(const ReplayOptions& options, SequenceIndex& index) {
  const fs::path file = options.dir / kWorldPoseFile;
  if (options.world_poses == WorldPoses::kGiven) {
    if (index.layout == SequenceLayout::kBop) return {};  // stand beside the intrinsics
    if (index.layout == SequenceLayout::kTum) return ReadTumWorldPoses(options.dir, index.frames);
    return ReadPoseFolder(options.dir, index.frames);
  }
  if (options.world_poses == WorldPoses::kNone || !fs::exists(file)) return {};
  return ReadAxisAnglePoses(file, index);
}

}  // namespace disflow::host
