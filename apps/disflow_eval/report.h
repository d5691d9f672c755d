// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "consistency.h"
#include "ground_truth.h"
#include "mesh_metrics.h"
#include "pose_metrics.h"
#include "surface_calibration.h"
#include "trajectory.h"

namespace disflow::apps {

/// Milliseconds of one stage, over the frames that give them.
struct StageTiming {
  std::string name;
  Statistics ms;
};

/// Timing of every stage column that holds a number.
[[nodiscard]] std::vector<StageTiming> EvaluateTiming(const EstimateTable& estimates);

/// All that an evaluation yields. Not copied: `run` points into `estimates`.
struct Report {
  Report() = default;
  Report(Report&&) = default;
  Report& operator=(Report&&) = default;

  std::string sequence;
  std::string note;  ///< What was left out of the sequence; empty: nothing.
  std::string csv;
  std::string model;
  std::size_t model_points = 0;
  bool has_velocities = false;
  GroundTruth truth;
  EstimateTable estimates;
  AlignedTrajectory run;  ///< Points into `estimates`.
  PoseMetrics poses;
  TruthDeviation truth_std;  ///< Counted in both consistencies.
  std::optional<Consistency> pose_consistency;
  std::optional<Consistency> twist_consistency;
  std::vector<StageTiming> stages;
  std::string mesh;  ///< Empty if none was given.
  std::optional<MeshComparison> surface;
  std::optional<SurfaceCalibration> surface_calibration;  ///< Of the seen part, if that is known.
};

/// One number of the report, ready to show.
struct ReportRow {
  std::string group;  ///< e.g. "Pose"
  std::string name;   ///< e.g. "ADD-AUC, up to 0.10 m"
  std::string value;  ///< e.g. "99.12 %"
};

/// The report's numbers in units that people use, in the order in which they are shown.
[[nodiscard]] std::vector<ReportRow> Rows(const Report& report);

/// A table for a terminal.
[[nodiscard]] std::string FormatTable(const Report& report);

/// The report as JSON: SI units, unit suffix in every key, null for what is not a number.
[[nodiscard]] std::string FormatJson(const Report& report);

}  // namespace disflow::apps
