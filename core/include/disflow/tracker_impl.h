// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/field/fast_math.h"
#include "disflow/field/known_surface.h"
#include "disflow/flow/weak_direction.h"
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
  seen_.Start();
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
  if (started_) T_oc_ = Predict(frame).Inverse();

  // Which pixels are the object, and which surface they show.
  status = Observe(frame, estimate, stopwatch);

  // V-B to V-D: the pose that puts the observed points onto the zero level of the distance field,
  // then the twist.
  if (started_) {
    const Aligned aligned = status == Status::kOk ? Register(frame, estimate) : Aligned{};
    stopwatch.Mark(Stage::kRegister);
    status = Conclude(frame, status, aligned, estimate);
    stopwatch.Mark(Stage::kFilter);
  } else if (status == Status::kOk) {
    StartObject(frame);
  }

  // V-E: what was observed becomes part of the model.
  if (status == Status::kOk) {
    RememberView(frame);
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
  seen_.Start();
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
  if (started_) {
    const bool doubtful = monitor_.Doubts(frame.stamp_ns);
    // A mask is then the better guide.
    prior = {!(doubtful && frame.mask.given()), doubtful, T_oc_, field_.bounds_min_m(),
             field_.bounds_max_m()};
  }
  const auto explains = [this](const Vec3& x_c) {
    return IsNearSurface(field_, T_oc_ * x_c, config_.segmenter.explained_m);
  };
  const Status segmented = scratch_.template Begin<Segmenter<Limits>>().Segment(
      frame, config_.segmenter, prior, explains, object_mask_, estimate.rejected);
  if (segmented != Status::kOk) return segmented;
  const ErodedMask interior(object_mask_, config_.sampler.border_px);
  stopwatch.Mark(Stage::kSegment);

  const DepthReader depth = UsableDepth(frame);
  auto& sampler = scratch_.template Begin<SurfaceSampler<Limits>>();
  sampler.Sample(depth, frame.camera, interior, config_.sampler, samples_, estimate.rejected);
  EdgeSampler<Limits>::Sample(depth, frame.camera, object_mask_, sampler, config_.sampler, edges_);
  estimate.samples = static_cast<std::uint16_t>(samples_.size());
  estimate.inverse_depth_std_per_m = sampler.noise_std();
  stopwatch.Mark(Stage::kSample);
  if (samples_.empty()) return Status::kNoValidDepth;
  return samples_.size() < config_.monitor.min_samples ? Status::kTooFewSamples : Status::kOk;
}

/// The depth image as far as it is within range.
template <class Limits>
DepthReader Tracker<Limits>::UsableDepth(const DepthFrame& frame) const noexcept {
  return {frame.depth, config_.segmenter.min_range_m, config_.segmenter.max_range_m};
}

/// What a frame's depth image says of the model at a pose.
template <class Limits>
ModelAgreement Tracker<Limits>::AgreementWith(const DepthFrame& frame,
                                              const PoseObjectFromCamera& T_oc) const noexcept {
  return Compare(field_, T_oc, frame.camera, UsableDepth(frame));
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
  registered_covariance_ = kDefinedPoseVariance * Mat6::Identity();
  observed_ns_ = frame.stamp_ns;
  monitor_.Start(config_.monitor, frame.stamp_ns);
  frame_index_ = 0;
  started_ = true;
}

template <class Limits>
typename Tracker<Limits>::Aligned Tracker<Limits>::Register(const DepthFrame& frame,
                                                            Estimate& estimate) noexcept {
  // Starting poses are compared on a part of the samples: they are many and need not be precise.
  const EveryNth some(samples_, PoseSearch<Limits>::kPoints);
  registration_.SetObservations(some, edges_);
  const typename PoseSearch<Limits>::Prior prior{
      T_oc_, T_oc_previous_, frame_index_ >= kFramesUntilVelocity,
      monitor_.Doubts(frame.stamp_ns) ? monitor_.missed() + 1 : 0};
  const auto conflict = [&](const PoseObjectFromCamera& T_oc) {
    return AgreementWith(frame, T_oc).conflict();
  };
  const auto start =
      PoseSearch<Limits>(registration_, field_, model_edges_, config_.registration, prior)
          .Find(conflict);
  registration_.SetObservations(samples_, edges_);
  Aligned aligned =
      registration_.Align(field_, model_edges_, config_.registration, start.T_oc, start.T_expected,
                          start.robust_scale, config_.registration.iterations);
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
  PoseCovariance covariance;
  if (aligned.solved) {
    covariance = CovarianceOf(aligned, frame.stamp_ns);
    const ModelAgreement agreement = AgreementWith(frame, aligned.T_oc);
    estimate.conflict = agreement.conflict();
    estimate.visible = agreement.visible();
    evidence = {covariance.solved,
                estimate.score,
                agreement.conflict(),
                aligned.inliers,
                registration_.size(),
                std::sqrt(covariance.reported.diagonal().template head<3>().maxCoeff()),
                std::sqrt(covariance.reported.diagonal().template tail<3>().maxCoeff())};
  }
  const bool near = !monitor_.Doubts(frame.stamp_ns) || IsSameObjectFrame(frame, aligned.T_oc);
  const bool accepted =
      observed == Status::kOk && near && monitor_.Accepts(evidence, frame.stamp_ns);
  evidence.registered = accepted;
  monitor_.Update(evidence, frame.stamp_ns);
  if (accepted) {
    T_oc_ = aligned.T_oc;
    T_oc_previous_ = T_oc_;
    if (covariance.twist_unobserved.isZero(0.0F)) observed_ns_ = frame.stamp_ns;
    // The twist filter sees differences between frames, in which the drift of the model cancels.
    twist_filter_.Predict(frame.stamp_ns);
    twist_filter_.Update(T_oc_.Inverse(), covariance.white);
    // Along a direction that the surface hardly tells, the motion up to now says more.
    estimate.weak = FindWeakDirection(covariance.reported, config_.monitor);
    if (estimate.weak.kind != WeakKind::kNone) T_oc_ = twist_filter_.T_co().Inverse();
    field_.SetGeneration(aligned.generation + 1.0F);
    registered_covariance_ = covariance.reported;
    estimate.pose_covariance = covariance.reported;
    estimate.twist_covariance = twist_filter_.twist_covariance() + covariance.twist_unobserved;
  } else {
    Coast(frame.stamp_ns, estimate);
  }
  if (observed != Status::kOk) return observed;
  return accepted ? Status::kOk : Status::kRegistrationFailed;
}

/// The pose at a constant velocity; at one that fades while the object is not seen, since what
/// moves by hand does not keep its velocity for long. An object that left the view is expected back
/// where it left.
template <class Limits>
PoseCameraFromObject Tracker<Limits>::Predict(const DepthFrame& frame) const noexcept {
  if (!monitor_.Doubts(frame.stamp_ns)) return twist_filter_.Extrapolate(frame.stamp_ns);
  const float gap_s = Seconds(frame.stamp_ns - twist_filter_.stamp_ns());
  const float moved_s = kFade_s * (1.0F - FastExpNonPositive(-gap_s / kFade_s));
  const auto moved_us = static_cast<std::int32_t>(moved_s * 1e6F);
  PoseCameraFromObject T_co =
      twist_filter_.Extrapolate(twist_filter_.stamp_ns() + StampNs{moved_us} * 1000);
  const auto in_view = [&frame](const Vec3& x_c) {
    if (!(x_c.z() > 0.0F)) return false;
    const Vec2 px = frame.camera.Project(x_c);
    return px.x() >= 0.0F && px.y() >= 0.0F && px.x() < static_cast<float>(frame.depth.width_px) &&
           px.y() < static_cast<float>(frame.depth.height_px);
  };
  if (in_view(T_co.translation())) return T_co;
  return {T_co.rotation(), T_oc_.Inverse().translation()};
}

/// Whether a pose that was searched for is that of the same object frame. Many things look alike
/// from opposite sides: neither may the pose be turned far from the predicted one, nor may the
/// object have had the time to turn over since it was last seen.
template <class Limits>
bool Tracker<Limits>::IsSameObjectFrame(const DepthFrame& frame,
                                        const PoseObjectFromCamera& T_oc) const noexcept {
  constexpr float kReach_rad = 0.7F;
  constexpr float kFarthestTurn_rad = 1.6F;
  const float gap_s = Seconds(frame.stamp_ns - twist_filter_.stamp_ns());
  const Vec3 off = LogSo3(Mat3(T_oc.rotation() * T_oc_.rotation().transpose()));
  return off.norm() <= kReach_rad &&
         gap_s * twist_filter_.twist().angular_rps.norm() <= kFarthestTurn_rad;
}

/// What is known of the motion of an object that is not seen. The filter itself stays at the last
/// registered frame: an acceleration measured there would carry a lost object away.
template <class Limits>
void Tracker<Limits>::Coast(StampNs stamp_ns, Estimate& estimate) const noexcept {
  TwistFilter coasting = twist_filter_;
  coasting.Predict(stamp_ns);
  estimate.twist_covariance = coasting.twist_covariance();
  // What it was then and what has been added since.
  estimate.pose_covariance = registered_covariance_ + coasting.pose_covariance();
  estimate.weak = FindWeakDirection(estimate.pose_covariance, config_.monitor);
}

/// Covariances of (origin's position, rotation) in camera axes.
template <class Limits>
typename Tracker<Limits>::PoseCovariance Tracker<Limits>::CovarianceOf(
    const Aligned& aligned, StampNs stamp_ns) const noexcept {
  constexpr float kLongest_s = 0.6F;  // a turn may then be anything
  const PoseUncertainty uncertainty =
      Uncertainty(aligned.information, config_.registration.gradient_std_rad);
  const Mat3 R_co = aligned.T_oc.rotation().transpose();
  const Vec3 to_origin_m = -aligned.center_m;
  const auto in_camera = [&](const Mat6& covariance_o) {
    return Moved(covariance_o, R_co, to_origin_m);
  };
  const auto since_s = static_cast<float>(static_cast<double>(stamp_ns - observed_ns_) * 1e-9);
  const float unobserved_s = std::min(since_s, kLongest_s);

  PoseCovariance result;
  result.solved = uncertainty.solved;
  result.white = config_.registration.white_noise_share * in_camera(uncertainty.covariance);
  result.reported =
      in_camera(WithDrift(uncertainty.covariance, aligned.generation, config_.registration));
  if (!uncertainty.IsComplete()) {
    result.twist_unobserved = in_camera(uncertainty.unobserved);
    const Mat6 turned = unobserved_s * unobserved_s * result.twist_unobserved;
    result.reported += turned;
    result.reported.template topLeftCorner<3, 3>() += OffTangent(turned);
  }
  result.white.diagonal().array() += kDefinedPoseVariance;
  result.reported.diagonal().array() += kDefinedPoseVariance;
  return result;
}

/// Whether a point lies in space that the camera has looked through.
template <class Limits>
bool Tracker<Limits>::IsForeign(const Vec3& x_o) const noexcept {
  return seen_.IsFree(x_o, config_.segmenter.free_margin_m);
}

template <class Limits>
void Tracker<Limits>::RememberView(const DepthFrame& frame) noexcept {
  const bool everything = !frame.mask.given() && config_.segmenter.grow_region == 0;
  if (everything || config_.segmenter.free_margin_m == 0.0F) return;
  constexpr float kFarthest_m = 60.0F;
  seen_.Add(DepthReader(frame.depth, config_.segmenter.min_range_m, kFarthest_m), frame.camera,
            T_oc_, object_mask_.box());
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
    if (IsForeign(observation.position_m)) {
      ++estimate.rejected.observations_rejected;
      continue;
    }
    (void)field_.Insert(observation, frame_index_,
                        estimate.rejected);  // the outcome is in the counters
  }
  for (const EdgePoint& point : edges_) {
    const EdgePoint moved{T_oc_ * point.position_m, R_oc * point.direction, R_oc * point.normal,
                          R_oc * point.ray, point.pixel_m};
    if (IsForeign(moved.position_m)) continue;
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
    if (estimate.pose_covariance.isZero(0.0F)) {
      estimate.pose_covariance = twist_filter_.pose_covariance();
      estimate.twist_covariance = twist_filter_.twist_covariance();
    }
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
