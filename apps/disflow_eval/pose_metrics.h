// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "statistics.h"
#include "trajectory.h"

namespace disflow::apps {

/// Threshold up to which ADD counts (the paper's tau).
inline constexpr double kAddLimit_m = 0.10;

/// Beyond either of these a pose that is called "tracking" is a false one.
inline constexpr double kFalseTranslation_m = 0.02;
inline constexpr double kFalseRotation_rad = 0.174532925199;  // 10 degrees

/// Errors of one frame.
struct FrameError {
  int frame = 0;
  double timestamp_s = 0.0;
  double add_m = 0.0;    ///< Mean distance of corresponding model points.
  double add_s_m = 0.0;  ///< Mean distance of nearest model points, for symmetric objects.
  double translation_m = 0.0;
  double rotation_rad = 0.0;
  double linear_mps = 0.0;
  double angular_rps = 0.0;
};

/// The metrics of the paper's section VI and their companions.
struct PoseMetrics {
  std::vector<FrameError> frames;  ///< Frames that have an estimate.
  double add_auc = 0.0;            ///< 0..1; frames without an estimate count as never accurate.
  double add_s_auc = 0.0;
  /// Over the frames that have an estimate.
  Statistics add_m, add_s_m, translation_m, rotation_rad, linear_mps, angular_rps;
  double final_translation_m = 0.0;  ///< Drift: the last frame's error.
  double final_rotation_rad = 0.0;
  /// Longest stretch of frames in a row that claim the state "tracking" though their pose is off by
  /// more than kFalse*: what a robot would act on wrongly.
  std::size_t longest_false_tracking = 0;
};

/// Distance of a point from the model, true object frame.
using ModelDistance = std::function<double(const Vec3d&)>;

/// @param model_points Points of the model, true object frame, not empty.
/// @param model_distance For ADD-S: asks for the surface between the points too, lest ADD-S measure
/// their spacing. Empty = the points are all there is.
[[nodiscard]] PoseMetrics EvaluatePoses(const AlignedTrajectory& run,
                                        const std::vector<Vec3d>& model_points,
                                        ModelDistance model_distance = {});

}  // namespace disflow::apps
