// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/status.h"

/// @file
/// Settings; Tracker::Adjust() changes some while it tracks. Capacities are in limits.h. The one
/// list of names, units, ranges and meanings is VisitFields() in config_fields.h; Validate(), the
/// TOML reader and docs/settings.md are made from it.

namespace disflow {

/// Where in its first image an object is that no mask shows.
struct ObjectStart {
  int roi_x_px = 0;
  int roi_y_px = 0;
  int roi_width_px = 0;
  int roi_height_px = 0;
  int seed_u_px = -1;
  int seed_v_px = -1;
  int seed_reach_px = 0;
};

/// Which pixels are the object.
struct SegmenterConfig : ObjectStart {
  float min_range_m = 0.10F;
  float max_range_m = 4.0F;
  float depth_jump_ratio = 0.02F;
  float model_margin_m = 0.03F;
  float explained_m = 0.012F;
  float free_margin_m = 0.012F;
  int mask_tolerance_px = 8;
  float mask_delay_s = 0.067F;
  float velocity_change_mps = 0.9F;
  float lost_margin_m = 0.1F;
  int grow_region = 1;
};

/// How surface samples are made of pixels.
struct SamplerConfig {
  int target_blocks = 1600;
  int min_block_px = 2;
  int max_block_px = 16;
  int border_px = 1;
  float min_cos_incidence = 0.12F;
  float min_fill = 0.5F;
  float max_residual_sigmas = 2.5F;
  float normal_std_rad = 0.15F;
  float max_bend_ratio = 5e-4F;
  float inverse_depth_std_per_m = 0.0F;
  float min_inverse_depth_std_per_m = 2e-5F;
  float sample_floor_m = 2e-5F;
  float edge_min_cos_incidence = 0.3F;
  float edge_background_gap_m = 0.02F;
};

/// The Gaussian-process distance field (section IV).
struct FieldConfig {
  float cell_size_m = 0.02F;
  float length_scale_m = 0.06F;
  float prior_gradient_std = 0.25F;
  float value_noise_m = 3e-5F;
  float normal_noise = 0.1F;
  float merge_radius_m = 0.004F;
  float overlap_m = 0.006F;
  int fit_to_object = 1;
  float crease_cos = 0.7F;
  float unknown_curvature_per_m = 20.0F;
  float reject_floor_m = 0.004F;
  int freeze_after = 15;
  int mature_after = 1;
  int retrain_budget = 4;
  int fuse_budget = 300;
};

/// Pose estimation (section V).
struct RegistrationConfig {
  int iterations = 8;
  float robust_scale_start_m = 0.010F;
  float robust_scale_sigmas = 1.0F;
  float truncation_m = 0.03F;
  float min_normal_cos = 0.6F;
  float match_radius_m = 0.010F;
  float min_gradient_norm = 0.3F;
  float damping = 1e-4F;
  float temporal_std_m = 0.005F;
  float temporal_std_rad = 0.03F;
  float edge_std_px = 0.3F;
  float edge_agreement = 0.8F;
  float hypothesis_score = 0.75F;
  int hypothesis_iterations = 3;
  int score_points = 120;
  float gradient_std_rad = 0.025F;
  float drift_noise = 16.0F;
  float drift_outline = 0.5F;
  float depth_bias_m = 0.0F;
};

/// Velocity at the capture time. The jerk is that of an object in a hand; what one has follows its
/// motion, see MotionNoise.
struct TwistFilterConfig {
  float linear_jerk_psd = 1.0F;
  float angular_jerk_psd = 15.0F;
};

/// When to trust, doubt and give up the pose.
struct MonitorConfig {
  int min_samples = 12;
  float degraded_score = 0.6F;
  float degraded_conflict = 0.15F;
  float degraded_std_m = 0.0067F;
  float degraded_std_rad = 0.058F;
  float weak_std_m = 0.004F;
  float weak_std_rad = 0.026F;
  float lost_score = 0.3F;
  float lost_conflict = 0.4F;
  float recovered_score = 0.75F;
  int lost_after_frames = 3;
  float reinitialise_after_s = 1.5F;
};

struct Config {
  SegmenterConfig segmenter;
  SamplerConfig sampler;
  FieldConfig field;
  RegistrationConfig registration;
  TwistFilterConfig twist;
  MonitorConfig monitor;
};

/// What Validate() found. `field` is null when all is well.
struct ConfigIssue {
  const char* field = nullptr;  ///< Dotted name, e.g. "field.cell_size_m"; static storage.
  double value = 0.0;
  double min = 0.0;  ///< Allowed range, both ends included; but max_range_m > min_range_m.
  double max = 0.0;

  [[nodiscard]] Status status() const noexcept {
    return field == nullptr ? Status::kOk : Status::kInvalidConfig;
  }
};

/// @return The first setting that is outside its range (NaN included), or an issue whose field is
/// null.
[[nodiscard]] ConfigIssue Validate(const Config& config) noexcept;

}  // namespace disflow
