// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>

#include "disflow/config.h"

namespace disflow {

/// One setting: where it is, what it is called, its allowed range, unit and meaning.
template <class Value>
struct ConfigField {
  const char* name;  ///< Dotted, as in the TOML file: "[registration]" then "iterations".
  Value& value;
  double min;
  double max;
  const char* unit;
  const char* meaning;
  bool at_run_time;  ///< Tracker::Adjust() may change it.
};

/// Calls visitor(ConfigField<float or int>) for every setting, in a fixed order.
/// @param config Config or const Config.
template <class ConfigType, class Visitor>
constexpr void VisitFields(ConfigType& config, Visitor&& visitor) {
  const auto visit = [&visitor](bool at_run_time, const char* name, auto& value, double min,
                                double max, const char* unit, const char* meaning) {
    visitor(ConfigField<std::remove_reference_t<decltype(value)>>{name, value, min, max, unit,
                                                                  meaning, at_run_time});
  };
  const auto field = [&visit](auto&&... what) { visit(true, what...); };
  // What the model is made with, or where the object is looked for first.
  const auto fixed = [&visit](auto&&... what) { visit(false, what...); };
  auto& seg = config.segmenter;
  field("segmenter.min_range_m", seg.min_range_m, 0.0, 100.0, "m", "nearest depth that is used");
  field("segmenter.max_range_m", seg.max_range_m, 0.01, 100.0, "m", "farthest depth that is used");
  field("segmenter.depth_jump_ratio", seg.depth_jump_ratio, 1e-4, 1.0, "m/m",
        "neighbouring pixels whose depths differ by more than this share of the depth belong to "
        "different surfaces; under a mask in coarse images more, as steep surface has it");
  field("segmenter.model_margin_m", seg.model_margin_m, 0.0, 1.0, "m",
        "without a mask, pixels farther than this from the predicted model are not the object");
  field("segmenter.explained_m", seg.explained_m, 1e-4, 1.0, "m",
        "pixels this close to the predicted model's surface are taken for the object");
  field("segmenter.free_margin_m", seg.free_margin_m, 0.0, 10.0, "m",
        "surface this far in front of what an earlier view saw behind it is not fused: it is not "
        "the object's; 0 = off");
  field("segmenter.mask_tolerance_px", seg.mask_tolerance_px, 0, 64, "px",
        "how far the outline of a given mask may be off, in either direction");
  field("segmenter.mask_delay_s", seg.mask_delay_s, 0.0, 1.0, "s",
        "how much older than its image a given mask may be: the tolerance grows by what the object "
        "moves in the image meanwhile");
  field(
      "segmenter.velocity_change_mps", seg.velocity_change_mps, 0.0, 10.0, "m/s",
      "by how much the object's velocity may change between two images; so far per second since it "
      "was last seen it is looked for about its prediction, at least within model_margin_m");
  field("segmenter.lost_margin_m", seg.lost_margin_m, 0.0, 1.0, "m",
        "added to model_margin_m at most, however long the object has not been seen");
  fixed("segmenter.roi_x_px", seg.roi_x_px, 0, 8192, "px", "region of interest, left edge");
  fixed("segmenter.roi_y_px", seg.roi_y_px, 0, 8192, "px", "region of interest, top edge");
  fixed("segmenter.roi_width_px", seg.roi_width_px, 0, 8192, "px",
        "region of interest; 0 = whole image");
  fixed("segmenter.roi_height_px", seg.roi_height_px, 0, 8192, "px",
        "region of interest; 0 = whole image");
  fixed("segmenter.seed_u_px", seg.seed_u_px, -1, 8191, "px",
        "a pixel on the object in the first frame; -1 = nearest");
  fixed("segmenter.seed_v_px", seg.seed_v_px, -1, 8191, "px",
        "a pixel on the object in the first frame; -1 = nearest");
  fixed("segmenter.seed_reach_px", seg.seed_reach_px, 0, 8192, "px",
        "surface this near to the seed in the image counts as lying there");
  field("segmenter.grow_region", seg.grow_region, 0, 1, "0/1",
        "without a mask: 1 = one connected surface is the object, 0 = all within range and region "
        "of interest (a room)");
  auto& sam = config.sampler;
  field("sampler.target_blocks", sam.target_blocks, 50, 20000, "1",
        "pixel blocks that shall cover the object");
  field("sampler.min_block_px", sam.min_block_px, 1, 64, "px", "smallest block edge");
  field("sampler.max_block_px", sam.max_block_px, 1, 64, "px", "largest block edge");
  field("sampler.border_px", sam.border_px, 0, 16, "px",
        "pixels this close to the object's outline are not fitted, since those on it are mixed, "
        "unless that takes more than an eighth of the object away");
  field("sampler.min_cos_incidence", sam.min_cos_incidence, 0.0, 0.99, "1",
        "surfaces seen at a smaller cosine between ray and normal are rejected as grazing");
  field("sampler.min_fill", sam.min_fill, 0.05, 1.0, "1",
        "share of a block's pixels that must carry depth, less of objects of few blocks");
  field("sampler.max_residual_sigmas", sam.max_residual_sigmas, 0.5, 20.0, "sigma",
        "plane fits that are worse are rejected as flying pixels or creases");
  field("sampler.normal_std_rad", sam.normal_std_rad, 0.01, 3.0, "rad",
        "blocks grow until noise leaves the normals of surface that faces the camera this sure");
  field("sampler.max_bend_ratio", sam.max_bend_ratio, 0.0, 0.1, "m/m",
        "deviation from a plane that curved surface may show, as share of the depth");
  field("sampler.inverse_depth_std_per_m", sam.inverse_depth_std_per_m, 0.0, 1.0, "1/m",
        "sensor noise of 1/z per pixel; 0 = estimated from every frame");
  field("sampler.min_inverse_depth_std_per_m", sam.min_inverse_depth_std_per_m, 1e-7, 1.0, "1/m",
        "lower bound of the estimated sensor noise");
  field("sampler.sample_floor_m", sam.sample_floor_m, 0.0, 0.1, "m",
        "standard deviation that every sample has at least");
  field("sampler.edge_min_cos_incidence", sam.edge_min_cos_incidence, 0.0, 0.99, "1",
        "occluding edges are taken from surfaces seen at least this steeply");
  field("sampler.edge_background_gap_m", sam.edge_background_gap_m, 0.001, 10.0, "m",
        "background behind an occluding edge is at least this much farther away");
  auto& fld = config.field;
  fixed("field.cell_size_m", fld.cell_size_m, 0.001, 2.0, "m", "edge of an octree leaf");
  fixed("field.length_scale_m", fld.length_scale_m, 0.002, 10.0, "m",
        "length scale of the Matern 3/2 kernel");
  fixed("field.prior_gradient_std", fld.prior_gradient_std, 0.01, 2.0, "1",
        "prior standard deviation of the gradient about the local plane");
  fixed("field.value_noise_m", fld.value_noise_m, 1e-6, 0.1, "m",
        "noise of a surface constraint, added to the sample's own");
  fixed("field.normal_noise", fld.normal_noise, 1e-3, 1.0, "1", "noise of a normal constraint");
  fixed("field.merge_radius_m", fld.merge_radius_m, 1e-4, 0.5, "m",
        "observations this close to a sample are averaged into it");
  fixed("field.overlap_m", fld.overlap_m, 0.0, 0.5, "m",
        "neighbouring cells' samples this close to the border are trained on too");
  fixed("field.fit_to_object", fld.fit_to_object, 0, 1, "0/1",
        "1 = where an object's first view is so large that its surface would not fit into the "
        "profile's local GPs, cell_size_m, merge_radius_m and overlap_m grow until it does");
  fixed("field.crease_cos", fld.crease_cos, 0.0, 0.99, "1",
        "normals whose cosine is smaller belong to different sides of a crease");
  fixed("field.unknown_curvature_per_m", fld.unknown_curvature_per_m, 0.0, 1000.0, "1/m",
        "how much the surface may bend where the samples end");
  fixed("field.reject_floor_m", fld.reject_floor_m, 0.0, 1.0, "m",
        "observations farther than this plus 3 sigma from known surface are not fused");
  fixed("field.freeze_after", fld.freeze_after, 1, 250, "1",
        "a sample stops moving after this many observations");
  fixed("field.mature_after", fld.mature_after, 1, 250, "1",
        "a sample is trained on after this many observations");
  field("field.retrain_budget", fld.retrain_budget, 1, 10000, "1",
        "local GPs retrained per frame at most");
  field("field.fuse_budget", fld.fuse_budget, 10, 100000, "1",
        "observations fused per frame at most");
  auto& reg = config.registration;
  field("registration.iterations", reg.iterations, 1, 50, "1",
        "closed-form steps per frame at most");
  field(
      "registration.robust_scale_start_m", reg.robust_scale_start_m, 1e-4, 1.0, "m",
      "robust kernel width at the first step of a search, narrower at each; half as much without");
  field("registration.robust_scale_sigmas", reg.robust_scale_sigmas, 0.5, 20.0, "sigma",
        "robust kernel width at the last step; up to twice as much where noise is all that "
        "residuals show");
  field("registration.truncation_m", reg.truncation_m, 1e-4, 1.0, "m",
        "residuals beyond are ignored");
  field("registration.min_normal_cos", reg.min_normal_cos, -1.0, 0.99, "1",
        "observed and model normal must agree this well");
  field("registration.match_radius_m", reg.match_radius_m, 1e-4, 1.0, "m",
        "tangential distance to the nearest model sample at most, or half the diagonal of a "
        "sample's block of pixels where that is more; not less than field.merge_radius_m");
  field("registration.min_gradient_norm", reg.min_gradient_norm, 0.0, 1.0, "1",
        "weaker gradients carry no information");
  field("registration.damping", reg.damping, 0.0, 1.0, "1",
        "Levenberg-Marquardt damping relative to diag(H)");
  field("registration.temporal_std_m", reg.temporal_std_m, 1e-5, 10.0, "m",
        "expected deviation from the predicted translation");
  field("registration.temporal_std_rad", reg.temporal_std_rad, 1e-5, 10.0, "rad",
        "expected deviation from the predicted rotation");
  field("registration.edge_std_px", reg.edge_std_px, 0.1, 100.0, "px",
        "least noise of an occluding edge in the image; ragged outlines have more, which is "
        "measured");
  field(
      "registration.edge_agreement", reg.edge_agreement, 0.0, 1.0, "1",
      "occluding edges count less when a smaller share of a frame's edges agrees with the model's; "
      "0 = always in full");
  field("registration.hypothesis_score", reg.hypothesis_score, 0.0, 1.0, "1",
        "below this score more starting poses are tried");
  field("registration.hypothesis_iterations", reg.hypothesis_iterations, 1, 20, "1",
        "steps per starting pose");
  field("registration.score_points", reg.score_points, 20, 500, "1",
        "samples used to score a pose");
  field(
      "registration.gradient_std_rad", reg.gradient_std_rad, 0.0, 1.0, "rad",
      "least error of the field's gradients, to which each frame adds what its normals show; what "
      "it makes up for a rotation does not count as known");
  field(
      "registration.drift_noise", reg.drift_noise, 0.0, 1000.0, "1",
      "variance of the place of each piece of surface that the model has grown by since the first "
      "view, in multiples of the pose's noise");
  field("registration.drift_outline", reg.drift_outline, 0.0, 100.0, "1",
        "what all of an outline is off by alike, in multiples of its standard deviation");
  field("registration.depth_bias_m", reg.depth_bias_m, 0.0, 1.0, "m",
        "what the sensor's depth is off by, differently in each view, beside its noise: a data "
        "sheet's accuracy");
  auto& twist = config.twist;
  field("twist.linear_jerk_psd", twist.linear_jerk_psd, 1e-6, 1e9, "m^2/s^5",
        "power density of the jerk, translation, at first; a thirtieth to three times as much is "
        "followed");
  field("twist.angular_jerk_psd", twist.angular_jerk_psd, 1e-6, 1e9, "rad^2/s^5",
        "power density of the jerk, rotation; likewise");
  auto& mon = config.monitor;
  field("monitor.min_samples", mon.min_samples, 10, 2000, "1",
        "fewer surface samples do not make a pose");
  field("monitor.degraded_score", mon.degraded_score, 0.0, 1.0, "1",
        "below this score the state is degraded");
  field("monitor.degraded_conflict", mon.degraded_conflict, 0.0, 1.0, "1",
        "with a larger share of the model not where it should be the state is degraded");
  field("monitor.degraded_std_m", mon.degraded_std_m, 0.0, 10.0, "m",
        "with a larger standard deviation of the position the state is degraded");
  field("monitor.degraded_std_rad", mon.degraded_std_rad, 0.0, 10.0, "rad",
        "with a larger standard deviation of the rotation the state is degraded");
  field("monitor.weak_std_m", mon.weak_std_m, 1e-6, 10.0, "m",
        "with a larger standard deviation along an axis that axis is named as weakly observed");
  field("monitor.weak_std_rad", mon.weak_std_rad, 1e-6, 10.0, "rad",
        "with a larger standard deviation about an axis that axis is named as weakly observed");
  field("monitor.lost_score", mon.lost_score, 0.0, 1.0, "1",
        "below this score the frame does not count as registered");
  field("monitor.lost_conflict", mon.lost_conflict, 0.0, 1.0, "1",
        "with a larger share of the model not where it should be the frame does not count as "
        "registered");
  field("monitor.recovered_score", mon.recovered_score, 0.0, 1.0, "1",
        "after a frame that did not count as registered, score that the next one needs");
  field("monitor.lost_after_frames", mon.lost_after_frames, 1, 1000, "frames",
        "unregistered frames in a row until lost");
  field("monitor.reinitialise_after_s", mon.reinitialise_after_s, 0.0, 3600.0, "s",
        "time after which a lost object is started anew");
}

/// @return The wanted settings, but those that may not change at run time as they are now.
[[nodiscard]] Config AdjustedAtRunTime(const Config& now, const Config& wanted) noexcept;

}  // namespace disflow
