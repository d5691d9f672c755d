// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config_fields.h"
#include "disflow/depth/edge_sampler.h"
#include "disflow/depth/eroded_mask.h"
#include "disflow/depth/seen_space_impl.h"
#include "disflow/depth/segmenter_anywhere_impl.h"
#include "disflow/depth/segmenter_choice_impl.h"
#include "disflow/depth/segmenter_impl.h"
#include "disflow/depth/whole_windows_impl.h"
#include "disflow/field/distance_field_fusion.h"
#include "disflow/field/distance_field_training.h"
#include "disflow/field/known_surface.h"
#include "disflow/flow/model_agreement.h"
#include "disflow/geometry/rigid_motion.h"
#include "disflow/stage_stopwatch.h"
#include "disflow/tracker.h"
#include "disflow/tracker_model_impl.h"
#include "disflow/tracker_pose_impl.h"
#include "disflow/tracker_search_impl.h"

/// @file
/// Definitions of Tracker's members. Only needed to instantiate a profile of your own; the shipped
/// ones are in the library.

namespace disflow {

template <CapacityProfile Limits>
Tracker<Limits>::Tracker(const Config& config) noexcept
    : config_(config), config_issue_(Validate(config)) {
  field_.Start(config_.field);
  model_edges_.Start();
  seen_.Start();
}

// Section V, in the order in which the paper tells it.
template <CapacityProfile Limits>
Status Tracker<Limits>::Process(const DepthFrame& frame, Estimate& estimate,
                                StageClock clock) noexcept {
  Begin(frame, estimate);
  StageStopwatch stopwatch(clock, estimate);
  Status status = Check(frame);
  if (status == Status::kStampNotIncreasing && late_.GoOn(frame.stamp_ns)) {
    Reset();
    status = Check(frame);
  }
  if (status != Status::kOk) return Refuse(status, frame, estimate);
  late_.Forget();
  if (TellsNothingNew(frame, estimate)) return Bridge(frame, estimate);

  // Where the object should be now, if it kept its velocity.
  if (started_) T_oc_ = Predict(frame).Inverse();

  // Which pixels are the object, and which surface they show.
  status = Observe(frame, estimate, stopwatch, started_ && monitor_.Doubts(frame.stamp_ns));

  // V-C to V-E: the pose that puts the observed points onto the zero level of the distance field,
  // then the twist.
  if (started_) {
    const Aligned aligned = status == Status::kOk ? Register(frame, estimate) : Aligned{};
    stopwatch.Mark(Stage::kRegister);
    status = Conclude(frame, status, aligned, estimate);
    stopwatch.Mark(Stage::kFilter);
  } else if (status == Status::kOk) {
    StartObject(frame);
  }

  // V-F: what was observed becomes part of the model.
  if (status == Status::kOk) {
    RememberView(frame);
    FuseObservations(frame, estimate);
    stopwatch.Mark(Stage::kFuse);
    Retrain(estimate);
    stopwatch.Mark(Stage::kRetrain);
  }
  return Finish(status, frame, estimate);
}

template <CapacityProfile Limits>
Status Tracker<Limits>::Fuse(const DepthFrame& frame, const PoseObjectFromCamera& T_oc,
                             Estimate& estimate, StageClock clock) noexcept {
  Begin(frame, estimate);
  StageStopwatch stopwatch(clock, estimate);
  Status status = IsRigid(T_oc) ? Check(frame) : Status::kInvalidTransform;
  if (status != Status::kOk) return Refuse(status, frame, estimate);
  T_oc_ = T_oc;
  // However long ago the last frame was: a known pose is never in doubt.
  status = Observe(frame, estimate, stopwatch, false);
  if (started_) {
    MoveTo(frame.stamp_ns, T_oc);
  } else if (status == Status::kOk) {
    StartField(frame);
    StartAt(frame.stamp_ns, T_oc, kKnownPoseVariance);
    monitor_.Confirm();
  }
  if (status == Status::kOk) {
    estimate.score = 1.0F;
    FuseObservations(frame, estimate);
    stopwatch.Mark(Stage::kFuse);
    Retrain(estimate);
    stopwatch.Mark(Stage::kRetrain);
  }
  return Finish(status, frame, estimate);
}

template <CapacityProfile Limits>
void Tracker<Limits>::Reset() noexcept {
  has_stamp_ = false;
  Forget();
}

template <CapacityProfile Limits>
void Tracker<Limits>::Forget() noexcept {
  if (started_) ++reset_counter_;
  started_ = false;
  nearest_in_vain_ = false;
  frame_index_ = 0;
  field_.Start(config_.field);
  model_edges_.Start();
  outline_scale_ = {};
  kernel_width_ = {};
  pose_noise_ = {};
  seen_.Start();
}

template <CapacityProfile Limits>
Status Tracker<Limits>::Choose(const ObjectStart& start) noexcept {
  Config chosen = config_;
  static_cast<ObjectStart&>(chosen.segmenter) = start;
  const ConfigIssue issue = Validate(chosen);
  if (issue.field != nullptr) return issue.status();
  config_ = chosen;
  config_issue_ = issue;
  Reset();
  return Status::kOk;
}

template <CapacityProfile Limits>
Status Tracker<Limits>::Adjust(const Config& config) noexcept {
  const Config adjusted = AdjustedAtRunTime(config_, config);
  const ConfigIssue issue = Validate(adjusted);
  if (issue.field != nullptr) return issue.status();
  config_ = adjusted;
  config_issue_ = issue;
  twist_filter_.Adjust(config_.twist);
  monitor_.Adjust(config_.monitor);
  return Status::kOk;
}

template <CapacityProfile Limits>
void Tracker<Limits>::Begin(const DepthFrame& frame, Estimate& estimate) noexcept {
  estimate = Estimate{};
  estimate.stamp_ns = frame.stamp_ns;
  estimate.rejected.frames = 1;
}

template <CapacityProfile Limits>
Status Tracker<Limits>::Check(const DepthFrame& frame) const noexcept {
  if (config_issue_.field != nullptr) return Status::kInvalidConfig;
  if (has_stamp_ && frame.stamp_ns <= last_stamp_ns_) return Status::kStampNotIncreasing;
  return CheckFrame(frame, Limits::kMaxImageWidth, Limits::kMaxImageHeight);
}

/// Whether the image is the last registered one once more, of an object that moved on meanwhile. An
/// image without noise of an object at rest looks the same again and again, and holds.
template <CapacityProfile Limits>
bool Tracker<Limits>::TellsNothingNew(const DepthFrame& frame, Estimate& estimate) noexcept {
  constexpr float kMoving_px_per_s = 20.0F;  // 2 pixels in the time of the longest hiccup
  if (!repeats_.IsRepeat(frame.depth, frame.stamp_ns)) return false;
  ++estimate.rejected.images_repeated;
  const bool registered = started_ && twist_filter_.stamp_ns() >= repeats_.first_ns();
  if (!registered) return false;
  return SpanNs(repeats_.first_ns(), frame.stamp_ns) <= kLongestHiccup_ns ||
         ImageSpeed(frame) > kMoving_px_per_s;
}

/// Predicts over a repeated image. A camera that hangs loses the object.
template <CapacityProfile Limits>
Status Tracker<Limits>::Bridge(const DepthFrame& frame, Estimate& estimate) noexcept {
  last_stamp_ns_ = frame.stamp_ns;
  T_oc_ = Predict(frame).Inverse();
  elsewhere_ = false;
  if (SpanNs(repeats_.first_ns(), frame.stamp_ns) > kLongestHiccup_ns) {
    (void)Conclude(frame, Status::kRepeatedImage, Aligned{}, estimate);
  } else {
    Coast(frame.stamp_ns, estimate);
  }
  return Finish(Status::kRepeatedImage, frame, estimate);
}

template <CapacityProfile Limits>
Status Tracker<Limits>::Observe(const DepthFrame& frame, Estimate& estimate,
                                StageStopwatch& stopwatch, bool doubtful) noexcept {
  has_stamp_ = true;
  last_stamp_ns_ = frame.stamp_ns;
  samples_.clear();
  edges_.clear();
  // Whatever lies there may be another object.
  if (!started_ && frame.mask.label != 0 && !frame.mask.given()) {
    object_mask_.Start(frame.depth.width_px, frame.depth.height_px);
    return Status::kEmptyMask;
  }
  const ModelPrior prior = PriorOf(frame, doubtful);
  const auto explains = [this](const Vec3& x_c) {
    return IsNearSurface(field_, T_oc_ * x_c, config_.segmenter.explained_m);
  };
  auto& segmenter = scratch_.template Begin<Segmenter<Limits>>();
  const Status segmented = segmenter.Segment(frame, config_.segmenter, prior, explains,
                                             object_mask_, overrun_, estimate.rejected);
  contact_ = segmenter.contact();
  elsewhere_ = segmenter.elsewhere() || (doubtful && LooksElsewhere(frame));
  if (segmented != Status::kOk) return segmented;
  const auto interior = InteriorOf(object_mask_, config_.sampler.border_px);
  stopwatch.Mark(Stage::kSegment);

  const DepthReader depth = UsableDepth(frame);
  auto& sampler = scratch_.template Begin<SurfaceSampler<Limits>>();
  sampler.Sample(depth, frame.camera, interior, config_.sampler, samples_, estimate.rejected);
  outline_ = EdgeSampler<Limits>::Sample(depth, frame.camera, object_mask_, frame.mask, sampler,
                                         config_.sampler, config_.registration.edge_std_px,
                                         outline_scale_, edges_);
  estimate.samples = static_cast<std::uint16_t>(samples_.size());
  estimate.inverse_depth_std_per_m = sampler.noise_std();
  stopwatch.Mark(Stage::kSample);
  if (samples_.empty()) return Status::kNoValidDepth;
  return samples_.size() < config_.monitor.min_samples ? Status::kTooFewSamples : Status::kOk;
}

/// The depth image as far as it is within range.
template <CapacityProfile Limits>
DepthReader Tracker<Limits>::UsableDepth(const DepthFrame& frame) const noexcept {
  return {frame.depth, config_.segmenter.min_range_m, config_.segmenter.max_range_m};
}

/// What a frame's depth image says of the model at a pose.
template <CapacityProfile Limits>
ModelAgreement Tracker<Limits>::AgreementWith(const DepthFrame& frame,
                                              const PoseObjectFromCamera& T_oc) const noexcept {
  return CompareWithImage(field_, T_oc, frame.camera, UsableDepth(frame));
}

/// The object frame: axes parallel to the camera's, origin at the first cloud's centroid.
template <CapacityProfile Limits>
void Tracker<Limits>::StartObject(const DepthFrame& frame) noexcept {
  Vec3 centroid = Vec3::Zero();
  for (const SurfaceSample& sample : samples_) centroid += sample.position_m;
  centroid /= static_cast<float>(samples_.size());
  StartField(frame);
  // The first pose is exact by definition of the object frame.
  StartAt(frame.stamp_ns, PoseObjectFromCamera(Mat3::Identity(), Vec3(-centroid)),
          kDefinedPoseVariance);
}

template <CapacityProfile Limits>
void Tracker<Limits>::StartAt(StampNs stamp_ns, const PoseObjectFromCamera& T_oc,
                              float variance) noexcept {
  T_oc_ = T_oc;
  T_oc_previous_ = T_oc;
  registered_covariance_ = variance * Mat6::Identity();
  gradient_variance_rad2_ = 0.0F;
  unobserved_o_.setZero();
  free_turn_o_.setZero();
  unheld_ = false;
  slip_.Start(stamp_ns);
  turn_part_ = 0;
  first_view_.Start();
  twist_filter_.Start(config_.twist, stamp_ns, T_oc.Inverse(), registered_covariance_);
  observed_ns_ = stamp_ns;
  monitor_.Start(config_.monitor, stamp_ns);
  recognition_.Forget();
  global_part_ = 0;
  free_axis_.Forget();
  frame_index_ = 0;
  started_ = true;
}

/// Takes a known pose for what a registration would have found.
template <CapacityProfile Limits>
void Tracker<Limits>::MoveTo(StampNs stamp_ns, const PoseObjectFromCamera& T_oc) noexcept {
  const float known_std = std::sqrt(kKnownPoseVariance);
  T_oc_previous_ = T_oc;
  twist_filter_.Predict(stamp_ns);
  twist_filter_.Update(T_oc.Inverse(), kKnownPoseVariance * Mat6::Identity());
  registered_covariance_ = twist_filter_.pose_covariance();
  unobserved_o_.setZero();
  free_turn_o_.setZero();
  unheld_ = false;
  slip_.Start(stamp_ns);
  observed_ns_ = stamp_ns;
  monitor_.Update({.registered = true,
                   .score = 1.0F,
                   .position_std_m = known_std,
                   .rotation_std_rad = known_std},
                  stamp_ns);
}

/// Of a frame that cannot be used: what is known without it. No state but the counters changes.
template <CapacityProfile Limits>
Status Tracker<Limits>::Refuse(Status status, const DepthFrame& frame,
                               Estimate& estimate) noexcept {
  estimate.status = status;
  estimate.reset_counter = reset_counter_;
  ++estimate.rejected.frames_rejected;
  totals_.Accumulate(estimate.rejected);
  const bool is_late = status == Status::kStampNotIncreasing;
  if (is_late) estimate.stamp_ns = last_stamp_ns_;
  if (!started_) return status;
  Report(is_late ? T_oc_.Inverse() : Predict(frame), estimate);
  Coast(estimate.stamp_ns, estimate);
  if (!is_late && monitor_.IsOverdue(frame.stamp_ns)) {
    estimate.state = TrackingState::kLost;
    estimate.quality = 0;
  }
  // The camera's pose is that of the frame's own stamp.
  if (!is_late && HasUsablePose(frame)) {
    estimate.has_T_wo = true;
    estimate.T_wo = frame.T_wc * estimate.T_co;
  }
  return status;
}

/// With the nearest surface and the largest in turn until one of them turns out to be something.
template <CapacityProfile Limits>
void Tracker<Limits>::StartAnew() noexcept {
  const bool in_vain = !monitor_.confirmed() && !nearest_in_vain_;
  Forget();
  nearest_in_vain_ = in_vain;
}

template <CapacityProfile Limits>
Status Tracker<Limits>::Finish(Status status, const DepthFrame& frame,
                               Estimate& estimate) noexcept {
  estimate.status = status;
  // Before the object may be given up: what is told is still of it.
  estimate.reset_counter = reset_counter_;
  if (status != Status::kOk) ++estimate.rejected.frames_unregistered;
  if (started_) {
    Report(T_oc_.Inverse(), estimate);
    if (estimate.pose_covariance.isZero(0.0F)) {
      estimate.pose_covariance = twist_filter_.pose_covariance();
      estimate.twist_covariance = twist_filter_.twist_covariance();
    }
    if (frame.has_T_wc) {
      estimate.has_T_wo = true;
      estimate.T_wo = frame.T_wc * estimate.T_co;
    }
    if (monitor_.ShouldRestart()) StartAnew();
  }
  totals_.Accumulate(estimate.rejected);
  return status;
}

/// What the tracker knows between frames too.
template <CapacityProfile Limits>
void Tracker<Limits>::Report(const PoseCameraFromObject& T_co, Estimate& estimate) const noexcept {
  estimate.T_co = T_co;
  // What noise turned it about is what the frame said itself.
  const Mat6 free_turn = RotatedCovariance(free_turn_o_, T_oc_.rotation().transpose());
  estimate.twist = KnownTwist(twist_filter_.twist(), free_turn,
                              Seconds(SpanNs(observed_ns_, twist_filter_.stamp_ns())));
  estimate.state = monitor_.state();
  estimate.quality = monitor_.quality();
}

}  // namespace disflow
