// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>

#include "disflow/host/obj_file.h"
#include "errors.h"
#include "estimate_csv.h"
#include "file_in_memory.h"
#include "foreign_trajectory.h"
#include "ground_truth.h"
#include "model_file.h"
#include "ply_file.h"

namespace {

using namespace disflow;
using fuzz::Require;

/// What disflow_eval and the simulator read: refused by name, or of a kind that can be used without
/// another look.
void CheckSurface(const apps::Surface& surface) {
  Require(surface.normals.empty() || surface.normals.size() == surface.vertices.size());
  Require(surface.stds_m.empty() || surface.stds_m.size() == surface.vertices.size());
  for (const auto& vertex : surface.vertices) Require(vertex.allFinite());
  for (const auto& triangle : surface.triangles) {
    for (const std::uint32_t corner : triangle) Require(corner < surface.vertices.size());
  }
}

void CheckSimulatedObject(const fuzz::FileInMemory& file) {
  host::TriangleMesh mesh;
  const hal::Fault fault = host::ReadObj(file.path(), mesh);
  Require(fault.ok() == (fault.message[0] == '\0'));
  if (!fault.ok()) return Require(mesh.triangles.empty());
  for (const auto& vertex : mesh.vertices) Require(vertex.allFinite());
  for (const host::TriangleMesh::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) Require(corner < mesh.vertices.size());
  }
}

void CheckEstimates(const std::string& file) {
  constexpr int kFrames = 1000;
  const apps::EstimateTable table = apps::LoadEstimates(file, kFrames);
  int last = -1;
  for (const apps::EstimateRow& row : table.rows) {
    Require(row.frame > last && row.frame < kFrames);
    Require(std::isfinite(row.timestamp_s));
    Require(row.stage_ms.size() == table.stage_names.size());
    if (row.has_motion) Require(row.T_co.IsFinite());
    last = row.frame;
  }
}

void CheckTruth(const std::filesystem::path& folder) {
  const apps::GroundTruth truth = apps::LoadGroundTruth(folder);
  Require(!truth.T_ct.empty());
  Require(truth.file_indices.size() == truth.T_ct.size());
  Require(truth.twists.empty() || truth.twists.size() == truth.T_ct.size());
  Require(truth.stamps_s.empty() || truth.stamps_s.size() == truth.T_ct.size());
}

/// Trajectories of others, of a sequence with a few frames.
void CheckForeign(const std::filesystem::path& file) {
  apps::GroundTruth sequence;
  sequence.T_ct.resize(4);
  sequence.stamps_s = {0.0, 1.0, 2.0, 3.0};
  sequence.file_indices = {0, 1, 2, 3};
  const apps::EstimateTable table = apps::LoadTrajectory(file, sequence, "");
  Require(!table.rows.empty());
  int last = -1;
  for (const apps::EstimateRow& row : table.rows) {
    Require(row.frame > last && row.frame < 4);
    Require(!row.has_motion || row.T_co.IsFinite());
    last = row.frame;
  }
}

void Check(std::uint8_t kind, const fuzz::FileInMemory& file) {
  static const fuzz::FolderWithFile obj(file, {"a.obj"});
  static const fuzz::FolderWithFile xyz(file, {"a.xyz"});
  static const fuzz::FolderWithFile truth(file, {"gt/poses.txt"});
  switch (kind % 7) {
    case 0:
      return CheckSurface(apps::LoadModel(obj.file()));
    case 1:
      return CheckSurface(apps::LoadModel(xyz.file()));
    case 2:
      return CheckSurface(apps::LoadPly(file.path()));
    case 3:
      return CheckSimulatedObject(file);
    case 4:
      return CheckEstimates(file.path());
    case 5:
      return CheckForeign(file.path());
    default:
      return CheckTruth(truth.path());
  }
}

}  // namespace

/// The first byte chooses the reader; the rest is the file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static fuzz::FileInMemory file;
  file.Fill(data + 1, size - 1);
  try {
    Check(data[0], file);
  } catch (const apps::InputError& error) {
    // Names the file.
    Require(error.what()[0] == '/');
  }
  return 0;
}
