// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "disflow/field/edge_sliver.h"
#include "disflow/field/fast_math.h"
#include "disflow/flow/model_agreement.h"
#include "disflow/flow/model_drift.h"
#include "disflow/flow/model_silhouette.h"
#include "disflow/flow/pose_search.h"
#include "disflow/flow/pose_uncertainty.h"
#include "disflow/flow/recentred.h"
#include "disflow/flow/weak_direction.h"
#include "disflow/geometry/covariance.h"
#include "disflow/memory/every_nth.h"
#include "disflow/tracker.h"

/// @file
/// Definitions of those members of Tracker that find and judge the pose of a frame; see
/// tracker_impl.h.

namespace disflow {

template <CapacityProfile Limits>
typename Tracker<Limits>::Aligned Tracker<Limits>::Register(const DepthFrame& frame,
                                                            Estimate& estimate) noexcept {
  // Starting poses are compared on a part of the samples: they are many and need not be precise.
  const EveryNth some(samples_, PoseSearch<Limits>::kPoints);
  auto& registration = scratch_.template Begin<Registration<Limits>>();
  registration.SetKernel(kernel_width_);
  registration.SetObservations(some, edges_);
  const PoseSearchPrior prior = SearchPrior(frame.stamp_ns);
  const auto conflict = [&](const PoseObjectFromCamera& T_oc) {
    return AgreementWith(frame, T_oc).conflict();
  };
  const auto start =
      PoseSearch<Limits>(registration, field_, model_edges_, config_.registration, prior)
          .Find(conflict);
  if (prior.global >= 0) global_part_ = (global_part_ + 1) % PairSearch<Limits>::kParts;
  DoubtSlivers(field_, start.T_oc, frame.camera, config_.sampler.edge_min_cos_incidence, edges_);
  registration.SetObservations(samples_, edges_);
  Aligned aligned =
      registration.Align(field_, model_edges_, config_.registration, start.T_oc, start.T_expected,
                         start.robust_scale, {config_.registration.iterations, start.held});
  if (aligned.solved) {
    if (slip_.free()) aligned = FindShift(registration, aligned, start.robust_scale);
    estimate.score = registration.ScoreOfAligned(field_, config_.registration, aligned.T_oc);
    if (IsTurnFree(frame.stamp_ns) && free_axis_.IsOne(free_turn_o_)) {
      aligned = FindTurn(frame, registration, aligned, start.robust_scale, estimate.score);
    }
    if (slip_.free()) {
      aligned.held_by_known = IsHeldBy(
          registration.KnownInformation(field_, model_edges_, config_.registration, aligned));
    }
  }
  estimate.hypotheses = static_cast<std::uint8_t>(start.tried);
  estimate.iterations = static_cast<std::uint8_t>(aligned.iterations);
  estimate.inliers = static_cast<std::uint16_t>(aligned.inliers);
  estimate.edge_inliers = static_cast<std::uint16_t>(aligned.edge_inliers);
  estimate.rms_m = aligned.rms_m;
  estimate.rejected.residuals_unmatched = static_cast<std::uint32_t>(aligned.unmatched);
  estimate.rejected.residuals_truncated = static_cast<std::uint32_t>(aligned.truncated);
  estimate.rejected.residuals_normal_mismatch = static_cast<std::uint32_t>(aligned.normal_mismatch);
  return aligned;
}

/// Believes the registered pose or not, and moves the twist filter and the monitor on.
template <CapacityProfile Limits>
Status Tracker<Limits>::Conclude(const DepthFrame& frame, Status observed, const Aligned& aligned,
                                 Estimate& estimate) noexcept {
  TrackingMonitor::Evidence evidence;
  PoseCovariance covariance;
  if (aligned.solved) {
    covariance = CovarianceOf(aligned, frame);
    const ModelAgreement agreement = AgreementWith(frame, aligned.T_oc);
    const float harmless =
        std::min(config_.monitor.degraded_conflict, config_.monitor.lost_conflict);
    estimate.conflict = agreement.conflict();
    estimate.visible = agreement.visible();
    evidence = {.registered = covariance.solved,
                .score = estimate.score,
                .conflict = agreement.conflict(),
                .resolved_conflict = ResolvedConflict(field_, aligned.T_oc, frame.camera,
                                                      UsableDepth(frame), agreement, harmless),
                .visible = agreement.visible(),
                .inliers = aligned.inliers,
                .points = aligned.points,
                .position_std_m = LargestPositionStd(covariance.reported),
                .rotation_std_rad = LargestRotationStd(covariance.reported),
                .position_to_model_std_m = LargestPositionStd(covariance.to_model),
                .rotation_to_model_std_rad = LargestRotationStd(covariance.to_model)};
  }
  const bool seen = observed == Status::kOk;
  // What is found elsewhere says nothing of whether the object is in view.
  if (!elsewhere_) in_view_ = seen;
  evidence.in_view = in_view_;
  const bool near =
      !monitor_.Doubts(frame.stamp_ns) || (!elsewhere_ && IsSameObjectFrame(frame, aligned.T_oc));
  const bool followed = seen && near && monitor_.Accepts(evidence, frame.stamp_ns);
  // Foreign surface in the model contradicts the true pose: unless it is forgotten at poses that
  // are refused for that alone, too, it keeps the object lost.
  const bool explained = seen && near && evidence.registered && monitor_.Explains(evidence);
  if (followed || explained) ForgetContradicted(frame, aligned.T_oc, estimate);
  const bool recognised = seen && !near && monitor_.Recognises(evidence);
  const bool found_again =
      recognition_.Confirm(recognised, aligned.T_oc, aligned.center_c, frame.stamp_ns);
  recognised_elsewhere_ = elsewhere_;
  recognition_.Consider(seen && !near && monitor_.Suspects(evidence), aligned.T_oc);
  evidence.registered = followed || found_again;
  monitor_.Update(evidence, frame.stamp_ns);
  if (evidence.registered) {
    Follow(frame.stamp_ns, aligned, covariance, found_again, estimate);
  } else {
    // A mask shows where it is; what it was doing when it was lost no longer does.
    const bool masked = frame.mask.given() && seen;
    if (masked && !near && FitsModel(aligned.center_c)) {
      T_oc_ = Recentred(field_, T_oc_, aligned.center_c);
    }
    Coast(frame.stamp_ns, estimate);
  }
  if (observed != Status::kOk) return observed;
  return evidence.registered ? Status::kOk : Status::kRegistrationFailed;
}

/// Whether what was observed is no larger than the model: through a mask that is off the background
/// is seen, and is farther away.
/// @param center_c Mean of the samples.
template <CapacityProfile Limits>
bool Tracker<Limits>::FitsModel(const Vec3& center_c) const noexcept {
  float squares_m2 = 0.0F;
  for (const SurfaceSample& sample : samples_) {
    squares_m2 += (sample.position_m - center_c).squaredNorm();
  }
  const float spread_m = std::sqrt(squares_m2 / static_cast<float>(samples_.size()));
  return spread_m <= 0.5F * (field_.bounds_max_m() - field_.bounds_min_m()).norm();
}

/// Takes the registered pose over.
/// @param found_again Where the object was before says nothing of its velocity.
template <CapacityProfile Limits>
void Tracker<Limits>::Follow(StampNs stamp_ns, const Aligned& aligned,
                             const PoseCovariance& covariance, bool found_again,
                             Estimate& estimate) noexcept {
  T_oc_ = aligned.T_oc;
  T_oc_previous_ = T_oc_;
  recognition_.Forget();
  global_part_ = 0;
  const bool complete = covariance.twist_unobserved.isZero(0.0F);
  if (complete) observed_ns_ = stamp_ns;
  // The twist filter sees differences between frames, in which the drift of the model cancels.
  if (found_again) {
    twist_filter_.Start(config_.twist, stamp_ns, T_oc_.Inverse(), covariance.white);
    pose_noise_.Restart();
  } else {
    twist_filter_.Predict(stamp_ns);
    if (aligned.shifted) {
      // How it moved along what nothing held it in was not known, either.
      twist_filter_.MoveTo(T_oc_.Inverse());
      twist_filter_.RestartMotion();
      pose_noise_.Restart();
      ForgetFoundShiftFree(estimate);
      slip_.Found();
    }
    if (aligned.turned) {
      twist_filter_.MoveTo(T_oc_.Inverse());
      pose_noise_.Restart();
      ForgetFoundTurnFree(estimate);
    }
    twist_filter_.Update(T_oc_.Inverse(), covariance.white,
                         {.stamp_variance_s2 = pose_noise_.of_stamps_s2(), .complete = complete});
  }
  pose_noise_.Learn(stamp_ns, T_oc_.Inverse(), aligned.center_m, covariance.registered,
                    twist_filter_.motion());
  estimate.weak = FindWeakDirection(covariance.reported, config_.monitor);
  model_edges_.SetRounding(Remember(model_edges_.rounding(), aligned.rounding));
  outline_scale_.Learn(outline_.source, aligned.edge_spread);
  kernel_width_.Learn(aligned.spread);
  field_.SetGeneration(aligned.generation + pose_noise_.of_rotation());
  field_.SetPieceVariance(covariance.piece_m2);
  registered_covariance_ = covariance.reported;
  gradient_variance_rad2_ =
      RememberGradientVariance(gradient_variance_rad2_, aligned.information.gradient_variance_rad2);
  unobserved_o_ = covariance.unobserved_o;
  free_turn_o_ = covariance.free_turn_o;
  unheld_ = covariance.unheld;
  slip_.Learn(stamp_ns, unheld_, covariance.free_shift_o, covariance.unobserved_s,
              aligned.held_by_known);
  field_.SetShiftFree(slip_.free());
  model_edges_.SetShiftFree(slip_.free());
  first_view_.Learn(covariance.registered_o, pose_noise_, covariance.outline_m);
  const bool turn_is_free = IsTurnFree(stamp_ns);
  field_.SetTurnFree(turn_is_free);
  if (turn_is_free) {
    const Mat3 R_co = T_oc_.rotation().transpose();
    twist_filter_.FadeTurn(RotatedCovariance(free_turn_o_, R_co), kFade_s);
  }
  free_axis_.Learn(covariance.free_turn_o);
  observed_frames_ = covariance.complete ? std::min(observed_frames_ + 1, kFramesUntilObserved) : 0;
  estimate.pose_covariance = covariance.reported;
  estimate.twist_covariance = TwistCovariance(twist_filter_, estimate.pose_covariance);
}

/// The pose at a constant velocity; at one that fades while the object is not seen, since what
/// moves by hand does not keep its velocity for long. An object that left the view is expected back
/// where it left.
template <CapacityProfile Limits>
PoseCameraFromObject Tracker<Limits>::Predict(const DepthFrame& frame) const noexcept {
  if (!monitor_.Doubts(frame.stamp_ns)) return twist_filter_.Extrapolate(frame.stamp_ns);
  const StampNs gap_ns = SpanNs(twist_filter_.stamp_ns(), frame.stamp_ns);
  const float moved_s = kFade_s * (1.0F - FastExpNonPositive(-Seconds(gap_ns) / kFade_s));
  const auto moved_us = static_cast<std::int32_t>(moved_s * 1e6F);
  // No farther than to the frame: near the end of time there is nothing beyond it.
  const StampNs moved_ns = std::min(StampNs{moved_us} * 1000, gap_ns);
  PoseCameraFromObject T_co = twist_filter_.Extrapolate(twist_filter_.stamp_ns() + moved_ns);
  const auto in_view = [&frame](const Vec3& x_c) {
    if (!(x_c.z() > 0.0F)) return false;
    const Vec2 px = frame.camera.Project(x_c);
    return px.x() >= 0.0F && px.y() >= 0.0F && px.x() < static_cast<float>(frame.depth.width_px) &&
           px.y() < static_cast<float>(frame.depth.height_px);
  };
  if (in_view(T_co.translation())) return T_co;
  return {T_co.rotation(), T_oc_.Inverse().translation()};
}

/// How fast the object moves in the image, pixels per second.
template <CapacityProfile Limits>
float Tracker<Limits>::ImageSpeed(const DepthFrame& frame) const noexcept {
  constexpr float kNearest_m = 0.1F;
  const PoseCameraFromObject T_co = T_oc_.Inverse();
  const Vec3 center_c = T_co * Vec3(0.5F * (field_.bounds_min_m() + field_.bounds_max_m()));
  const Twist twist = twist_filter_.twist();
  const Vec3 velocity_mps =
      twist.linear_mps + twist.angular_rps.cross(Vec3(center_c - T_co.translation()));
  // The outline turns about the centre; half way out it moves as it does on average.
  const float lever_m = 0.25F * (field_.bounds_max_m() - field_.bounds_min_m()).norm();
  const float speed_mps = velocity_mps.norm() + twist.angular_rps.norm() * lever_m;
  const float pixel_per_m = frame.camera.fx_px / std::max(center_c.z(), kNearest_m);
  return speed_mps * pixel_per_m;
}

/// What was not known of the pose when the object was last seen, and what has been added since.
template <CapacityProfile Limits>
Mat6 Tracker<Limits>::CoastedCovariance(StampNs stamp_ns) const noexcept {
  TwistFilter coasting = twist_filter_;
  coasting.Predict(stamp_ns);
  return registered_covariance_ + coasting.pose_covariance();
}

/// What is known of the motion of an object that is not seen. The filter itself stays at the last
/// registered frame: an acceleration measured there would carry a lost object away.
template <CapacityProfile Limits>
void Tracker<Limits>::Coast(StampNs stamp_ns, Estimate& estimate) const noexcept {
  TwistFilter coasting = twist_filter_;
  coasting.Predict(stamp_ns);
  estimate.pose_covariance = CoastedCovariance(stamp_ns);
  estimate.twist_covariance = TwistCovariance(coasting, estimate.pose_covariance);
  estimate.weak = FindWeakDirection(estimate.pose_covariance, config_.monitor);
}

/// The noise of poses is alike for some frames, of which the filter, and PoseNoise, see only what
/// changes from one to the next. The velocity is that of the origin, wherever on the body that is.
template <CapacityProfile Limits>
Mat6 Tracker<Limits>::TwistCovariance(const TwistFilter& filter,
                                      const Mat6& pose_covariance) const noexcept {
  constexpr float kAlike = 1.5F;
  const Mat6 unobserved_o = Steadied(unobserved_o_, free_turn_o_);
  Mat6 result = kAlike * filter.twist_covariance() +
                RotatedCovariance(unobserved_o, T_oc_.rotation().transpose());
  const Vec3 rate_rps = filter.twist().angular_rps;
  const Mat3 rate2_rps2 = rate_rps * rate_rps.transpose() + result.bottomRightCorner<3, 3>();
  result.topLeftCorner<3, 3>() +=
      VelocityCovarianceOfPlace(pose_covariance.topLeftCorner<3, 3>(), rate2_rps2);
  return result;
}

/// What a frame left unobserved, with the axis that turns freely where the frames before saw it.
template <CapacityProfile Limits>
Mat6 Tracker<Limits>::Steadied(const Mat6& unobserved_o, const Mat6& free_turn_o) const noexcept {
  return unobserved_o - free_turn_o + free_axis_.Steadied(free_turn_o);
}

/// Whether what was known before the object may have slid holds it in its place.
template <CapacityProfile Limits>
bool Tracker<Limits>::IsHeldBy(RegistrationInformation known) const noexcept {
  known.gradient_variance_rad2 =
      RememberGradientVariance(gradient_variance_rad2_, known.gradient_variance_rad2);
  const PoseUncertainty uncertainty =
      FindPoseUncertainty(known, config_.registration.gradient_std_rad);
  return uncertainty.solved && !uncertainty.MayShift();
}

/// Covariances of (origin's position, rotation) in camera axes.
template <CapacityProfile Limits>
typename Tracker<Limits>::PoseCovariance Tracker<Limits>::CovarianceOf(
    const Aligned& aligned, const DepthFrame& frame) const noexcept {
  constexpr float kLongest_s = 0.6F;  // a turn may then be anything
  const float least_gradient_std = config_.registration.gradient_std_rad;
  RegistrationInformation information = aligned.information;
  information.gradient_variance_rad2 =
      RememberGradientVariance(gradient_variance_rad2_, information.gradient_variance_rad2);
  const PoseUncertainty uncertainty = FindPoseUncertainty(information, least_gradient_std);
  // From frame to frame the model errs alike.
  information.gradient_variance_rad2 = 0.0F;
  const PoseUncertainty change = FindPoseUncertainty(information, least_gradient_std);
  const Mat3 R_co = aligned.T_oc.rotation().transpose();
  const Vec3 to_origin_m = -aligned.center_m;
  const auto in_camera = [&](const Mat6& covariance_o) {
    return CovarianceAtPoint(covariance_o, R_co, to_origin_m);
  };
  const auto in_object = [&](const Mat6& covariance_o) {
    return CovarianceAtPoint(covariance_o, Mat3::Identity(), to_origin_m);
  };
  const float since_s = Seconds(SpanNs(observed_ns_, frame.stamp_ns));
  const float unobserved_s = std::min(since_s, kLongest_s);

  PoseCovariance result;
  const float common_px = config_.registration.drift_outline * outline_.std_px;
  result.outline_m = common_px * aligned.center_c.z() / frame.camera.fx_px;
  const PlacementScale placement{
      .pieces = aligned.generation, .outline_m = result.outline_m, .lever_m = LeverOf(information)};
  result.solved = uncertainty.solved;
  result.piece_m2 = PieceVariance(uncertainty.of_observed, placement, config_.registration);
  result.registered = change.covariance;
  result.white = in_camera(pose_noise_.Of(change.covariance));
  result.to_model = in_camera(pose_noise_.Of(uncertainty.covariance));
  result.reported = in_camera(pose_noise_.Of(uncertainty.of_observed) +
                              DriftOf(uncertainty.of_observed, placement, config_.registration));
  result.unobserved_o = in_object(uncertainty.unobserved);
  result.free_turn_o = in_object(uncertainty.free_turn);
  // What looks alike at all turns about its axis is recognised by all else.
  const bool turns_freely = free_axis_.Leaves(free_turn_o_) && free_axis_.IsOne(result.free_turn_o);
  if (turns_freely && !uncertainty.MayShift()) {
    result.to_model = in_camera(pose_noise_.Of(uncertainty.of_observed));
  }
  if (uncertainty.IsComplete() && observed_frames_ < kFramesUntilObserved &&
      !monitor_.Doubts(frame.stamp_ns)) {
    // One frame that seems to tell it does not: it stays the object's own axis. Of an object that
    // was lost nothing of the frames before counts.
    result.unobserved_o = unobserved_o_;
    result.free_turn_o = free_turn_o_;
  }
  result.twist_unobserved =
      RotatedCovariance(Steadied(result.unobserved_o, result.free_turn_o), R_co);
  result.complete = uncertainty.IsComplete();
  result.unheld = uncertainty.MayShift();
  result.free_shift_o = result.unobserved_o - result.free_turn_o;
  result.unobserved_s = unobserved_s;
  result.registered_o = in_object(uncertainty.of_observed);
  result.reported += RotatedCovariance(first_view_.Covariance(R_co, result.outline_m), R_co);
  const Mat6 free_turn = result.twist_unobserved - RotatedCovariance(result.free_shift_o, R_co);
  const Mat6 slid_o = slip_.Covariance(result.free_shift_o, unobserved_s);
  const Mat6 may_have_moved =
      unobserved_s * unobserved_s * free_turn + RotatedCovariance(slid_o, R_co);
  if (!may_have_moved.isZero(0.0F)) result.reported += OnItsArc(may_have_moved);
  result.white.diagonal().array() += kDefinedPoseVariance;
  result.reported.diagonal().array() += kDefinedPoseVariance;
  // Rotations make displacements of the origin, with the rounding errors of what they are made of.
  Vec6 beside = Vec6::Zero();
  beside.head<3>().setConstant(to_origin_m.squaredNorm() *
                               result.reported.diagonal().template tail<3>().maxCoeff());
  result.reported = Resolvable(result.reported, beside);
  return result;
}

}  // namespace disflow
