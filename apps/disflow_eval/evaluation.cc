// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation.h"

#include "errors.h"
#include "ground_truth.h"
#include "mesh_metrics.h"
#include "model_file.h"
#include "ply_file.h"
#include "surface.h"
#include "visibility.h"

namespace disflow::apps {
namespace {

/// Points for ADD from a mesh; ADD changes by less than a thousandth with more.
constexpr std::size_t kAddPoints = 2000;

std::filesystem::path FindModel(const EvaluationInput& input) {
  if (!input.model.empty()) return input.model;
  std::filesystem::path file = input.sequence_dir / "gt" / "model.obj";
  if (!std::filesystem::exists(file)) {
    throw InputError(file, "does not exist; name the object's model with --model");
  }
  return file;
}

}  // namespace

Report Evaluate(const EvaluationInput& input) {
  Report report;
  report.sequence = input.sequence_dir.string();
  report.csv = input.csv.string();
  const GroundTruth truth = LoadGroundTruth(input.sequence_dir);
  report.estimates = LoadEstimates(input.csv, static_cast<int>(truth.T_ct.size()));
  const std::filesystem::path model_file = FindModel(input);
  report.model = model_file.string();
  const Surface model = LoadModel(model_file);
  const std::vector<Vec3d> model_points = Positions(SampleSurface(model, kAddPoints));

  report.model_points = model_points.size();
  report.has_velocities = !truth.twists.empty();
  report.run = Align(truth, report.estimates);
  report.poses = EvaluatePoses(report.run, model_points);
  report.pose_consistency = EvaluatePoseConsistency(report.run);
  if (report.has_velocities) report.twist_consistency = EvaluateTwistConsistency(report.run);
  report.stages = EvaluateTiming(report.estimates);
  if (!input.mesh.empty()) {
    report.mesh = input.mesh.string();
    const Surface mesh = Move(report.run.T_ot.Inverse(), LoadPly(input.mesh));
    const std::vector<SurfacePoint> samples = SampleSurface(model, kMeshSamples);
    report.surface =
        CompareMeshes(mesh, model, samples, FindSeen(input.sequence_dir, truth, samples));
  }
  return report;
}

}  // namespace disflow::apps
