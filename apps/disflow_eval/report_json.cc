// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "report.h"
#include "units.h"

namespace disflow::apps {
namespace {

using Json = nlohmann::ordered_json;

/// @param scale Factor from SI to the unit of the key that will hold this.
Json ToJson(const Statistics& s, double scale = 1.0) {
  return {{"count", s.count},           {"mean", scale * s.mean}, {"rmse", scale * s.rms},
          {"median", scale * s.median}, {"p95", scale * s.p95},   {"p99", scale * s.p99},
          {"max", scale * s.max}};
}

Json ToJson(const Consistency& c) {
  return {{"nees_mean", c.statistics.mean},
          {"nees_median", c.statistics.median},
          {"share_inside_2_5_to_97_5", c.share_inside},
          {"share_below_95", c.share_below_95},
          {"frames", c.nees.size()},
          {"not_positive_definite", c.singular}};
}

Json ToJson(const MeshMetrics& m) {
  return {{"chamfer_m", m.chamfer_m},
          {"mesh_to_model_m", m.accuracy_m},
          {"model_to_mesh_m", m.completeness_m},
          {"hausdorff_m", m.hausdorff_m},
          {"f_1mm", m.f_score[0]},
          {"f_2mm", m.f_score[1]},
          {"f_5mm", m.f_score[2]},
          {"mesh_to_model_normal_deg", kDegrees * m.mesh_to_model_normal_rad},
          {"model_to_mesh_normal_deg", kDegrees * m.model_to_mesh_normal_rad}};
}

Json ToJson(const SurfaceCalibration& c) {
  Json bins = Json::array();
  for (const SurfaceCalibration::Bin& bin : c.bins)
    bins.push_back({{"std_m", bin.std_m}, {"error_m", bin.error_m}});
  return {{"vertices", c.vertices},
          {"std_m", c.std_m},
          {"error_m", c.error_m},
          {"error_over_std", c.error_m / c.std_m},
          {"share_within_1_std", c.share_within[0]},
          {"share_within_2_std", c.share_within[1]},
          {"share_within_3_std", c.share_within[2]},
          {"bins", bins}};
}

}  // namespace

std::string FormatJson(const Report& report) {
  const PoseMetrics& m = report.poses;
  Json json = {{"sequence", report.sequence},
               {"csv", report.csv},
               {"model", report.model},
               {"model_points", report.model_points},
               {"frames",
                {{"sequence", report.run.frame_count},
                 {"estimated", report.run.frames.size()},
                 {"lost", report.run.lost},
                 {"missing", report.run.missing()},
                 {"stamp_mismatches", report.run.stamp_mismatches},
                 {"aligned_at", report.run.aligned_frame}}},
               {"add_auc_percent", kPercent * m.add_auc},
               {"add_s_auc_percent", kPercent * m.add_s_auc},
               {"add_m", ToJson(m.add_m)},
               {"add_s_m", ToJson(m.add_s_m)},
               {"translation_m", ToJson(m.translation_m)},
               {"rotation_deg", ToJson(m.rotation_rad, kDegrees)},
               {"final_drift_m", m.final_translation_m},
               {"final_drift_deg", kDegrees * m.final_rotation_rad},
               {"longest_false_tracking_frames", m.longest_false_tracking}};
  if (report.has_velocities) {
    json["linear_velocity_mps"] = ToJson(m.linear_mps);
    json["angular_velocity_degps"] = ToJson(m.angular_rps, kDegrees);
  }
  const TruthDeviation& truth = report.truth_std;
  if (report.pose_consistency) {
    json["pose_consistency"] = ToJson(*report.pose_consistency);
    json["pose_consistency"]["truth_std_m"] = truth.position_m;
    json["pose_consistency"]["truth_std_deg"] = kDegrees * truth.rotation_rad;
  }
  if (report.twist_consistency) {
    json["twist_consistency"] = ToJson(*report.twist_consistency);
    json["twist_consistency"]["truth_std_mps"] = truth.linear_mps;
    json["twist_consistency"]["truth_std_degps"] = kDegrees * truth.angular_rps;
  }
  if (report.surface) {
    json["surface"] = {{"mesh", report.mesh},
                       {"whole", ToJson(report.surface->whole)},
                       {"seen", ToJson(report.surface->seen)},
                       {"seen_share", report.surface->seen_share}};
    if (report.surface_calibration)
      json["surface"]["calibration"] = ToJson(*report.surface_calibration);
  }
  for (const StageTiming& stage : report.stages) json["time_ms"][stage.name] = ToJson(stage.ms);
  // File names need not be UTF-8; a replaced byte is better than no report.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace disflow::apps
