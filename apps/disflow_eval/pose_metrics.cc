// SPDX-License-Identifier: BSD-3-Clause
#include "pose_metrics.h"

#include <algorithm>

#include "point_index.h"

namespace disflow::apps {
namespace {

/// Motion of the true object frame from its estimated place to where it is.
using Offset = Transform<TrueObject, TrueObject, double>;

double MeanDistance(const Offset& offset, const std::vector<Vec3d>& points) {
  double sum = 0.0;
  for (const Vec3d& point : points) sum += (offset * point - point).norm();
  return sum / static_cast<double>(points.size());
}

double MeanNearestDistance(const Offset& offset, const std::vector<Vec3d>& points,
                           const ModelDistance& model_distance) {
  double sum = 0.0;
  for (const Vec3d& point : points) sum += model_distance(offset * point);
  return sum / static_cast<double>(points.size());
}

FrameError EvaluateFrame(const AlignedFrame& frame, const std::vector<Vec3d>& points,
                         const ModelDistance& model_distance) {
  // Distances do not depend on the frame, so they are measured in the object's.
  const Offset true_to_estimated = frame.T_ct.Inverse() * frame.T_ct_estimated;
  // ADD-S asks for the nearest estimated point of every true one: the estimate stays, truth moves.
  const Offset estimated_to_true = true_to_estimated.Inverse();
  FrameError error;
  error.frame = frame.row->frame;
  error.timestamp_s = frame.row->timestamp_s;
  error.add_m = MeanDistance(true_to_estimated, points);
  error.add_s_m = MeanNearestDistance(estimated_to_true, points, model_distance);
  error.translation_m = (frame.T_ct_estimated.translation() - frame.T_ct.translation()).norm();
  error.rotation_rad = LogSo3(true_to_estimated.rotation()).norm();
  error.linear_mps = (frame.twist_estimated.linear_mps - frame.twist.linear_mps).norm();
  error.angular_rps = (frame.twist_estimated.angular_rps - frame.twist.angular_rps).norm();
  return error;
}

std::vector<double> Column(const std::vector<FrameError>& frames, double FrameError::*member) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const FrameError& frame : frames) values.push_back(frame.*member);
  return values;
}

std::size_t LongestFalseTracking(const AlignedTrajectory& run,
                                 const std::vector<FrameError>& errors) {
  std::size_t longest = 0;
  std::size_t current = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const bool is_off = errors[i].translation_m > kFalseTranslation_m ||
                        errors[i].rotation_rad > kFalseRotation_rad;
    current = is_off && run.frames[i].row->state == "tracking" ? current + 1 : 0;
    longest = std::max(longest, current);
  }
  return longest;
}

}  // namespace

PoseMetrics EvaluatePoses(const AlignedTrajectory& run, const std::vector<Vec3d>& model_points,
                          ModelDistance model_distance) {
  const PointIndex index(model_points);
  if (!model_distance) {
    model_distance = [&index](const Vec3d& point) { return index.NearestDistance(point); };
  }
  PoseMetrics metrics;
  for (const AlignedFrame& frame : run.frames) {
    metrics.frames.push_back(EvaluateFrame(frame, model_points, model_distance));
  }
  const std::vector<double> add = Column(metrics.frames, &FrameError::add_m);
  const std::vector<double> add_s = Column(metrics.frames, &FrameError::add_s_m);
  metrics.add_auc = AreaUnderAccuracy(add, run.frame_count, kAddLimit_m);
  metrics.add_s_auc = AreaUnderAccuracy(add_s, run.frame_count, kAddLimit_m);
  metrics.add_m = Summarise(add);
  metrics.add_s_m = Summarise(add_s);
  metrics.translation_m = Summarise(Column(metrics.frames, &FrameError::translation_m));
  metrics.rotation_rad = Summarise(Column(metrics.frames, &FrameError::rotation_rad));
  metrics.linear_mps = Summarise(Column(metrics.frames, &FrameError::linear_mps));
  metrics.angular_rps = Summarise(Column(metrics.frames, &FrameError::angular_rps));
  metrics.final_translation_m = metrics.frames.back().translation_m;
  metrics.final_rotation_rad = metrics.frames.back().rotation_rad;
  metrics.longest_false_tracking = LongestFalseTracking(run, metrics.frames);
  return metrics;
}

}  // namespace disflow::apps
