// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation.h"

#include <utility>

#include "foreign_trajectory.h"
#include "mesh_metrics.h"
#include "nearest_surface.h"
#include "ply_file.h"
#include "sequence.h"
#include "surface.h"
#include "surface_calibration.h"
#include "visibility.h"

namespace disflow::apps {
namespace {

/// Points for ADD from a mesh; ADD changes by a few thousandths with more.
constexpr std::size_t kAddPoints = 500;
/// Where the search for the nearest point of a mesh begins.
constexpr std::size_t kAddSurfacePoints = 10000;

}  // namespace

Report Evaluate(const EvaluationInput& input) {
  Report report;
  report.sequence = input.sequence;
  report.csv = input.csv.string();
  Sequence sequence = OpenSequence(input.sequence, input.model, input.object);
  const GroundTruth& truth = sequence.truth;
  report.note = truth.note;
  report.estimates = LoadTrajectory(input.csv, truth, input.object);
  report.model = sequence.model_name;
  const Surface& model = *sequence.model;
  const std::vector<Vec3d> model_points = Positions(SampleSurface(model, kAddPoints));

  report.model_points = model_points.size();
  report.has_velocities = !truth.twists.empty() && report.estimates.has_twists;
  report.run = Align(truth, report.estimates);
  const NearestSurface nearest(model, SampleSurface(model, kAddSurfacePoints));
  report.poses = EvaluatePoses(report.run, model_points,
                               [&nearest](const Vec3d& x) { return nearest.Find(x).distance; });
  report.truth_std = input.truth_std;
  report.pose_consistency = EvaluatePoseConsistency(report.run, input.truth_std);
  if (report.has_velocities) {
    report.twist_consistency = EvaluateTwistConsistency(report.run, input.truth_std);
  }
  report.stages = EvaluateTiming(report.estimates);
  if (!input.mesh.empty()) {
    report.mesh = input.mesh.string();
    const Surface mesh = Move(report.run.T_ot.Inverse(), LoadPly(input.mesh));
    const std::vector<SurfacePoint> samples = SampleSurface(model, kMeshSamples);
    const std::vector<bool> seen = FindSeen(sequence, samples);
    report.surface = CompareMeshes(mesh, model, samples, seen);
    report.surface_calibration = CalibrateSurface(mesh, NearestSurface(model, samples), seen);
  }
  report.truth = std::move(sequence.truth);
  return report;
}

}  // namespace disflow::apps
