// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/symmetric_solver.h"
#include "disflow/tracker.h"

/// @file
/// Definitions of Tracker's members. Only needed to instantiate a profile of your own; the shipped
/// ones are in the library.

namespace disflow {

template <class Limits>
Tracker<Limits>::Tracker(const Config& config) noexcept
    : config_(config), config_issue_(Validate(config)) {
  field_.Start(config_.field);
  model_edges_.Start();
}

// Section V, in the order in which the paper tells it.
template <class Limits>
Status Tracker<Limits>::Process(const DepthFrame& frame, Estimate& estimate,
                                StageClock clock) noexcept {
  Begin(frame, estimate);
  StageStopwatch stopwatch(clock, estimate);
  Status status = Check(frame);
  if (status != Status::kOk) return Finish(status, frame, estimate);

  // Where the object should be now, if it kept its velocity.
  if (started_) T_oc_ = twist_filter_.Extrapolate(frame.stamp_ns).Inverse();

  // Which pixels are the object, and which surface they show.
  status = Observe(frame, estimate, stopwatch);

  // V-B to V-D: the pose that puts the observed points onto the zero level of the distance field,
  // then the twist.
  if (started_) {
    const Aligned aligned = status == Status::kOk ? Register(estimate) : Aligned{};
    stopwatch.Mark(Stage::kRegister);
    status = Conclude(frame, status, aligned, estimate);
    stopwatch.Mark(Stage::kFilter);
  } else if (status == Status::kOk) {
    StartObject(frame);
  }

  // V-E: what was observed becomes part of the model.
  if (status == Status::kOk) {
    FuseObservations(estimate);
    stopwatch.Mark(Stage::kFuse);
    Retrain();
    stopwatch.Mark(Stage::kRetrain);
  }
  return Finish(status, frame, estimate);
}

template <class Limits>
Status Tracker<Limits>::Fuse(const DepthFrame& frame, const PoseObjectFromCamera& T_oc,
                             Estimate& estimate, StageClock clock) noexcept {
  Begin(frame, estimate);
  StageStopwatch stopwatch(clock, estimate);
  Status status = T_oc.IsFinite() ? Check(frame) : Status::kInvalidTransform;
  if (status != Status::kOk) return Finish(status, frame, estimate);
  T_oc_ = T_oc;
  status = Observe(frame, estimate, stopwatch);
  if (status == Status::kOk) {
    if (started_) {
      twist_filter_.Predict(frame.stamp_ns);
      twist_filter_.Update(T_oc_.Inverse(), kKnownPoseVariance * Mat6::Identity());
    } else {
      twist_filter_.Start(config_.twist, frame.stamp_ns, T_oc_.Inverse(),
                          kKnownPoseVariance * Mat6::Identity());
      monitor_.Start(config_.monitor, frame.stamp_ns);
      started_ = true;
    }
    estimate.score = 1.0F;
    FuseObservations(estimate);
    stopwatch.Mark(Stage::kFuse);
    Retrain();
    stopwatch.Mark(Stage::kRetrain);
  }
  return Finish(status, frame, estimate);
}

template <class Limits>
void Tracker<Limits>::Reset() noexcept {
  if (started_) ++reset_counter_;
  started_ = false;
  frame_index_ = 0;
  field_.Start(config_.field);
  model_edges_.Start();
}

template <class Limits>
void Tracker<Limits>::Begin(const DepthFrame& frame, Estimate& estimate) noexcept {
  estimate = Estimate{};
  estimate.stamp_ns = frame.stamp_ns;
  estimate.rejected.frames = 1;
}

template <class Limits>
Status Tracker<Limits>::Check(const DepthFrame& frame) const noexcept {
  if (config_issue_.field != nullptr) return Status::kInvalidConfig;
  if (has_stamp_ && frame.stamp_ns <= last_stamp_ns_) return Status::kStampNotIncreasing;
  return CheckFrame(frame, Limits::kMaxImageWidth, Limits::kMaxImageHeight);
}

template <class Limits>
Status Tracker<Limits>::Observe(const DepthFrame& frame, Estimate& estimate,
                                StageStopwatch& stopwatch) noexcept {
  has_stamp_ = true;
  last_stamp_ns_ = frame.stamp_ns;
  samples_.clear();
  edges_.clear();
  ModelPrior prior;
  if (started_) prior = {true, T_oc_, field_.bounds_min_m(), field_.bounds_max_m()};
  const Status segmented =
      segmenter_.Segment(frame, config_.segmenter, prior, object_mask_, estimate.rejected);
  if (segmented != Status::kOk) return segmented;
  interior_mask_.Erode(object_mask_, config_.sampler.border_px);
  stopwatch.Mark(Stage::kSegment);

  const DepthReader depth(frame.depth, config_.segmenter.min_range_m,
                          config_.segmenter.max_range_m);
  sampler_.Sample(depth, frame.camera, interior_mask_, config_.sampler, samples_,
                  estimate.rejected);
  EdgeSampler<Limits>::Sample(depth, frame.camera, object_mask_, sampler_, config_.sampler, edges_);
  estimate.samples = static_cast<std::uint16_t>(samples_.size());
  estimate.inverse_depth_std_per_m = sampler_.noise_std();
  stopwatch.Mark(Stage::kSample);
  if (samples_.empty()) return Status::kNoValidDepth;
  return samples_.size() < config_.monitor.min_samples ? Status::kTooFewSamples : Status::kOk;
}

/// The object frame: axes parallel to the camera's, origin at the first cloud's centroid.
template <class Limits>
void Tracker<Limits>::StartObject(const DepthFrame& frame) noexcept {
  Vec3 centroid = Vec3::Zero();
  for (const SurfaceSample& sample : samples_) centroid += sample.position_m;
  centroid /= static_cast<float>(samples_.size());
  T_oc_ = PoseObjectFromCamera(Mat3::Identity(), Vec3(-centroid));
  T_oc_previous_ = T_oc_;
  // The first pose is exact by definition of the object frame.
  twist_filter_.Start(config_.twist, frame.stamp_ns, T_oc_.Inverse(),
                      kDefinedPoseVariance * Mat6::Identity());
  monitor_.Start(config_.monitor, frame.stamp_ns);
  frame_index_ = 0;
  started_ = true;
}

template <class Limits>
typename Tracker<Limits>::Aligned Tracker<Limits>::Register(Estimate& estimate) noexcept {
  registration_.SetObservations(samples_, edges_);
  const auto start =
      PoseSearch<Limits>::Find(registration_, field_, model_edges_, config_.registration, T_oc_,
                               T_oc_previous_, frame_index_ >= kFramesUntilVelocity);
  // Where the prediction was not believed it must not pull either.
  const PoseObjectFromCamera& T_expected = start.tried > 1 ? start.T_oc : T_oc_;
  Aligned aligned = registration_.Align(field_, model_edges_, config_.registration, start.T_oc,
                                        T_expected, config_.registration.iterations);
  estimate.hypotheses = static_cast<std::uint8_t>(start.tried);
  estimate.iterations = static_cast<std::uint8_t>(aligned.iterations);
  estimate.inliers = static_cast<std::uint16_t>(aligned.inliers);
  estimate.edge_inliers = static_cast<std::uint16_t>(aligned.edge_inliers);
  estimate.rms_m = aligned.rms_m;
  estimate.score = registration_.Score(field_, config_.registration, aligned.T_oc);
  estimate.rejected.residuals_unmatched = static_cast<std::uint32_t>(aligned.unmatched);
  estimate.rejected.residuals_truncated = static_cast<std::uint32_t>(aligned.truncated);
  estimate.rejected.residuals_normal_mismatch = static_cast<std::uint32_t>(aligned.normal_mismatch);
  return aligned;
}

/// Believes the registered pose or not, and moves the twist filter and the monitor on.
template <class Limits>
Status Tracker<Limits>::Conclude(const DepthFrame& frame, Status observed, const Aligned& aligned,
                                 Estimate& estimate) noexcept {
  TrackingMonitor::Evidence evidence;
  Mat6 covariance = Mat6::Zero();
  if (aligned.solved) {
    covariance = PoseCovariance(aligned);
    evidence = {true,
                estimate.score,
                aligned.inliers,
                registration_.size(),
                std::sqrt(covariance.diagonal().head<3>().maxCoeff()),
                std::sqrt(covariance.diagonal().tail<3>().maxCoeff())};
  }
  const bool accepted = observed == Status::kOk && monitor_.Accepts(evidence);
  twist_filter_.Predict(frame.stamp_ns);
  if (accepted) {
    T_oc_ = aligned.T_oc;
    T_oc_previous_ = T_oc_;
    twist_filter_.Update(T_oc_.Inverse(), covariance);
  } else {
    T_oc_ = twist_filter_.T_co().Inverse();
    evidence.registered = false;
  }
  monitor_.Update(evidence, frame.stamp_ns);
  // The twist filter sees differences between frames, in which the drift of the model cancels; the
  // pose does not.
  estimate.pose_covariance = twist_filter_.pose_covariance();
  if (accepted) {
    estimate.pose_covariance =
        (1.0F + config_.registration.drift_inflation * (1.0F + aligned.generation)) * covariance;
    field_.SetGeneration(aligned.generation + 1.0F);
  }
  if (observed != Status::kOk) return observed;
  return accepted ? Status::kOk : Status::kRegistrationFailed;
}

/// Covariance of (origin's position, rotation) in camera axes from the information about the
/// centre, object frame.
template <class Limits>
Mat6 Tracker<Limits>::PoseCovariance(const Aligned& aligned) const noexcept {
  const Mat6 covariance_o = SymmetricSolver6(aligned.information).Inverse();
  // T_oc' = exp(xi) T_oc moves the object's origin by -t + theta x c and turns the object by
  // -theta, object axes.
  const Mat3 R_co = aligned.T_oc.rotation().transpose();
  Mat6 jacobian = Mat6::Zero();
  jacobian.template topLeftCorner<3, 3>() = -R_co;
  jacobian.template topRightCorner<3, 3>() = -R_co * Skew(aligned.center_m);
  jacobian.template bottomRightCorner<3, 3>() = -R_co;
  const Mat6 covariance_c = jacobian * covariance_o * jacobian.transpose();
  Mat6 inflated = config_.registration.covariance_inflation * covariance_c;
  inflated.diagonal().array() += kDefinedPoseVariance;
  return inflated;
}

template <class Limits>
void Tracker<Limits>::FuseObservations(Estimate& estimate) noexcept {
  const bool first = frame_index_ == 0;
  const int wanted = first ? samples_.size() : std::min(samples_.size(), config_.field.fuse_budget);
  // The subset moves from frame to frame, so that every part of the image gets its turn.
  const int offset = static_cast<int>(frame_index_ % 7U);
  const Mat3& R_oc = T_oc_.rotation();
  for (int i = 0; i < wanted; ++i) {
    const auto index = (static_cast<std::int64_t>(i) * samples_.size() + offset) / wanted;
    SurfaceSample observation = samples_[std::min(static_cast<int>(index), samples_.size() - 1)];
    observation.position_m = T_oc_ * observation.position_m;
    observation.normal = R_oc * observation.normal;
    (void)field_.Insert(observation, frame_index_,
                        estimate.rejected);  // the outcome is in the counters
  }
  for (const EdgePoint& point : edges_) {
    const EdgePoint moved{T_oc_ * point.position_m, R_oc * point.direction, R_oc * point.normal,
                          R_oc * point.ray, point.pixel_m};
    model_edges_.Insert(moved, config_.field.merge_radius_m, estimate.rejected);
  }
}

template <class Limits>
void Tracker<Limits>::Retrain() noexcept {
  const int factor = frame_index_ < kInitialFrames ? kInitialBudgetFactor : 1;
  (void)field_.Retrain(factor * config_.field.retrain_budget);
  ++frame_index_;
}

template <class Limits>
Status Tracker<Limits>::Finish(Status status, const DepthFrame& frame,
                               Estimate& estimate) noexcept {
  estimate.status = status;
  if (status != Status::kOk) {
    const bool refused =
        status == Status::kInvalidConfig || status == Status::kStampNotIncreasing ||
        CheckFrame(frame, Limits::kMaxImageWidth, Limits::kMaxImageHeight) != Status::kOk;
    ++(refused ? estimate.rejected.frames_rejected : estimate.rejected.frames_unregistered);
  }
  if (started_) {
    estimate.T_co = T_oc_.Inverse();
    estimate.twist = twist_filter_.twist();
    estimate.twist_covariance = twist_filter_.twist_covariance();
    if (estimate.pose_covariance.isZero(0.0F))
      estimate.pose_covariance = twist_filter_.pose_covariance();
    estimate.state = monitor_.state();
    estimate.quality = monitor_.quality();
    if (frame.has_T_wc) {
      estimate.has_T_wo = frame.T_wc.IsFinite();
      estimate.T_wo = frame.T_wc * estimate.T_co;
    }
    if (monitor_.ShouldRestart(last_stamp_ns_)) Reset();
  }
  estimate.reset_counter = reset_counter_;
  totals_.Accumulate(estimate.rejected);
  return status;
}

}  // namespace disflow
