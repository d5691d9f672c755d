// SPDX-License-Identifier: BSD-3-Clause
#include "report.h"

#include <cmath>

#include "units.h"

namespace disflow::apps {
namespace {

/// Collects rows of one group after the other.
class RowWriter {
 public:
  void Begin(std::string group) { group_ = std::move(group); }
  template <class... Values>
  void Add(const char* name, const char* format, Values... values) {
    rows_.push_back({group_, name, Format(format, values...)});
  }
  [[nodiscard]] std::vector<ReportRow> Take() { return std::move(rows_); }

 private:
  std::string group_;
  std::vector<ReportRow> rows_;
};

void AddFrames(const Report& report, RowWriter& rows) {
  const AlignedTrajectory& run = report.run;
  rows.Begin("Frames");
  rows.Add("of the sequence", "%zu", run.frame_count);
  rows.Add("estimated", "%zu (aligned at frame %d)", run.frames.size(), run.aligned_frame);
  rows.Add("lost", "%zu", run.lost);
  rows.Add("missing, counted as failed", "%zu", run.missing());
  if (run.stamp_mismatches > 0) {
    rows.Add("stamped otherwise than data.txt", "%zu: right CSV?", run.stamp_mismatches);
  }
}

void AddPoses(const PoseMetrics& m, RowWriter& rows) {
  rows.Begin("Pose");
  rows.Add("ADD-AUC, up to 0.10 m", "%.2f %%", kPercent * m.add_auc);
  rows.Add("ADD-S-AUC, up to 0.10 m", "%.2f %%", kPercent * m.add_s_auc);
  const auto distance = [&](const char* name, const Statistics& s) {
    rows.Add(name, "%.3f / %.3f / %.3f mm", kMillimetres * s.mean, kMillimetres * s.p95,
             kMillimetres * s.max);
  };
  distance("ADD: mean / p95 / max", m.add_m);
  distance("ADD-S: mean / p95 / max", m.add_s_m);
  rows.Add("translation e_t: RMSE", "%.4f cm (%.3f mm)", kCentimetres * m.translation_m.rms,
           kMillimetres * m.translation_m.rms);
  rows.Add("translation e_t: p95 / max", "%.3f / %.3f mm", kMillimetres * m.translation_m.p95,
           kMillimetres * m.translation_m.max);
  rows.Add("rotation e_a: RMSE", "%.3f deg", kDegrees * m.rotation_rad.rms);
  rows.Add("rotation e_a: p95 / max", "%.3f / %.3f deg", kDegrees * m.rotation_rad.p95,
           kDegrees * m.rotation_rad.max);
  rows.Add("final drift", "%.3f mm, %.3f deg", kMillimetres * m.final_translation_m,
           kDegrees * m.final_rotation_rad);
  rows.Add("longest false 'tracking'", "%zu frames", m.longest_false_tracking);
}

void AddVelocities(const PoseMetrics& m, RowWriter& rows) {
  rows.Begin("Velocity");
  rows.Add("linear: RMSE", "%.3f cm/s", kCentimetres * m.linear_mps.rms);
  rows.Add("linear: p95 / max", "%.3f / %.3f cm/s", kCentimetres * m.linear_mps.p95,
           kCentimetres * m.linear_mps.max);
  rows.Add("angular: RMSE", "%.3f deg/s", kDegrees * m.angular_rps.rms);
  rows.Add("angular: p95 / max", "%.3f / %.3f deg/s", kDegrees * m.angular_rps.p95,
           kDegrees * m.angular_rps.max);
}

void AddConsistency(const char* group, const Consistency& c, RowWriter& rows) {
  rows.Begin(group);
  rows.Add("NEES: mean (6 expected) / median", "%.2f / %.2f", c.statistics.mean,
           c.statistics.median);
  rows.Add("inside 2.5-97.5 % bounds", "%.1f %%", kPercent * c.share_inside);
  rows.Add("below 95 % bound", "%.1f %%", kPercent * c.share_below_95);
  rows.Add("frames / not positive definite", "%zu / %zu", c.nees.size(), c.singular);
}

void AddTiming(const std::vector<StageTiming>& stages, RowWriter& rows) {
  rows.Begin("Time per frame: median / p99 / max");
  for (const StageTiming& stage : stages) {
    rows.Add(stage.name.c_str(), "%.3f / %.3f / %.3f ms", stage.ms.median, stage.ms.p99,
             stage.ms.max);
  }
}

void AddSurface(const char* group, const MeshMetrics& m, RowWriter& rows) {
  rows.Begin(group);
  rows.Add("Chamfer", "%.3f mm", kMillimetres * m.chamfer_m);
  rows.Add("mesh to model / model to mesh", "%.3f / %.3f mm", kMillimetres * m.accuracy_m,
           kMillimetres * m.completeness_m);
  rows.Add("Hausdorff", "%.3f mm", kMillimetres * m.hausdorff_m);
  rows.Add("F at 1 / 2 / 5 mm", "%.3f / %.3f / %.3f", m.f_score[0], m.f_score[1], m.f_score[2]);
  rows.Add("normals, mesh to model / back", "%.2f / %.2f deg",
           kDegrees * m.mesh_to_model_normal_rad, kDegrees * m.model_to_mesh_normal_rad);
}

void AddCalibration(const SurfaceCalibration& c, RowWriter& rows) {
  rows.Begin("Surface, standard deviation");
  rows.Add("stated / true error, rms", "%.3f / %.3f mm", kMillimetres * c.std_m,
           kMillimetres * c.error_m);
  rows.Add("vertices within 1 / 2 / 3 of it", "%.1f / %.1f / %.1f %%", kPercent * c.share_within[0],
           kPercent * c.share_within[1], kPercent * c.share_within[2]);
}

}  // namespace

std::vector<StageTiming> EvaluateTiming(const EstimateTable& estimates) {
  std::vector<StageTiming> stages;
  for (std::size_t i = 0; i < estimates.stage_names.size(); ++i) {
    std::vector<double> ms;
    for (const EstimateRow& row : estimates.rows) {
      if (std::isfinite(row.stage_ms[i])) ms.push_back(row.stage_ms[i]);
    }
    if (!ms.empty()) stages.push_back({estimates.stage_names[i], Summarise(std::move(ms))});
  }
  return stages;
}

std::vector<ReportRow> Rows(const Report& report) {
  RowWriter rows;
  AddFrames(report, rows);
  AddPoses(report.poses, rows);
  if (report.has_velocities) AddVelocities(report.poses, rows);
  const TruthDeviation& truth = report.truth_std;
  if (report.pose_consistency) {
    AddConsistency("Pose consistency", *report.pose_consistency, rows);
    if (truth.position_m > 0.0 || truth.rotation_rad > 0.0) {
      rows.Add("counted in, of the truth itself", "%.3f mm, %.3f deg",
               kMillimetres * truth.position_m, kDegrees * truth.rotation_rad);
    }
  }
  if (report.twist_consistency) {
    AddConsistency("Twist consistency", *report.twist_consistency, rows);
    if (truth.linear_mps > 0.0 || truth.angular_rps > 0.0) {
      rows.Add("counted in, of the truth itself", "%.3f cm/s, %.3f deg/s",
               kCentimetres * truth.linear_mps, kDegrees * truth.angular_rps);
    }
  }
  if (report.surface) {
    AddSurface("Surface, whole", report.surface->whole, rows);
    if (std::isfinite(report.surface->seen_share)) {
      AddSurface("Surface, seen part", report.surface->seen, rows);
      rows.Add("seen of the model", "%.1f %%", kPercent * report.surface->seen_share);
    } else {
      rows.Add("seen part", "%s", "not known: no depth images beside the truth");
    }
  }
  if (report.surface_calibration) AddCalibration(*report.surface_calibration, rows);
  AddTiming(report.stages, rows);
  return rows.Take();
}

std::string FormatTable(const Report& report) {
  const std::vector<ReportRow> rows = Rows(report);
  std::string table;
  const std::string* group = nullptr;
  for (const ReportRow& row : rows) {
    if (group == nullptr || *group != row.group) table += row.group + "\n";
    group = &row.group;
    table += Format("  %-34s %s\n", row.name.c_str(), row.value.c_str());
  }
  return table;
}

}  // namespace disflow::apps
