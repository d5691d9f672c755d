// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/flow/model_agreement.h"
#include "disflow/flow/pose_search.h"
#include "disflow/flow/shift_search.h"
#include "disflow/flow/turn_search.h"
#include "disflow/tracker.h"

/// @file
/// Definitions of those members of Tracker that look for an object elsewhere than registration
/// finds it; see tracker_impl.h.

namespace disflow {

/// Whether what was recognised away from where the object is predicted is looked at again.
template <CapacityProfile Limits>
bool Tracker<Limits>::LooksElsewhere(const DepthFrame& frame) const noexcept {
  return recognised_elsewhere_ && !frame.mask.given() &&
         (recognition_.pending() || recognition_.suspected());
}

/// What is known of where the object is in the image.
template <CapacityProfile Limits>
ModelPrior Tracker<Limits>::PriorOf(const DepthFrame& frame, bool doubtful) noexcept {
  ModelPrior prior;
  prior.nearest_in_vain = nearest_in_vain_;
  if (!started_) return prior;
  contact_.turned_rad += TurnBetween(T_oc_previous_.rotation(), T_oc_.rotation()).norm();
  const bool elsewhere = doubtful && LooksElsewhere(frame);
  // In every other frame: what touches something is found about its prediction alone.
  const bool anywhere = doubtful && !elsewhere && monitor_.state() == TrackingState::kLost &&
                        monitor_.missed() % 2 == 1;
  // A mask is then the better guide.
  prior.known = !(doubtful && frame.mask.given());
  prior.doubtful = doubtful;
  prior.anywhere = anywhere;
  prior.unseen_s = Seconds(SpanNs(twist_filter_.stamp_ns(), frame.stamp_ns));
  prior.T_oc = elsewhere ? recognition_.T_oc() : T_oc_;
  prior.box_min_m = field_.bounds_min_m();
  prior.box_max_m = field_.bounds_max_m();
  prior.contact = contact_;
  prior.motion_px = config_.segmenter.mask_delay_s * ImageSpeed(frame);
  return prior;
}

/// Where to look for the object: near the prediction, after a few frames in vain turned anyhow, and
/// where it was recognised.
template <CapacityProfile Limits>
PoseSearchPrior Tracker<Limits>::SearchPrior(StampNs stamp_ns) const noexcept {
  PoseSearchPrior prior{T_oc_, T_oc_previous_, frame_index_ >= kFramesUntilVelocity,
                        monitor_.Doubts(stamp_ns) ? monitor_.missed() + 1 : 0};
  prior.contradicted = monitor_.contradicted();
  prior.unheld = unheld_;
  const bool found = recognition_.pending() || recognition_.suspected();
  if (found) {
    prior.T_predicted = recognition_.T_oc();
    prior.turned_over = true;
  }
  // What is found is compared with what is found elsewhere, too.
  if (found || elsewhere_ || monitor_.searched() >= kLocalSearches) {
    prior.global = global_part_;
    prior.expected_turn = {T_oc_.rotation(),
                           CoastedCovariance(stamp_ns).template bottomRightCorner<3, 3>()};
  }
  return prior;
}

/// Whether nothing has told the turn about an axis of the object's for some time.
template <CapacityProfile Limits>
bool Tracker<Limits>::IsTurnFree(StampNs stamp_ns) const noexcept {
  constexpr float kForgotten_s = 0.3F;  // in which a hand may turn it by half of what it likes
  return !free_turn_o_.isZero(0.0F) && Seconds(SpanNs(observed_ns_, stamp_ns)) > kForgotten_s;
}

/// The registered pose, or one that is turned about the free axis and explains more.
/// @param score Of what is returned.
template <CapacityProfile Limits>
typename Tracker<Limits>::Aligned Tracker<Limits>::FindTurn(const DepthFrame& frame,
                                                            Registration<Limits>& registration,
                                                            const Aligned& aligned,
                                                            RobustScale scale,
                                                            float& score) noexcept {
  const TurnAxis axis = AxisOf(free_axis_.mean());
  TurnSearch<Limits> search(field_, config_.registration, registration.samples(), aligned.T_oc,
                            axis, turn_part_);
  turn_part_ = (turn_part_ + 1) % TurnSearch<Limits>::kParts;
  if (!search.Find()) return aligned;
  Aligned turned = registration.Align(field_, model_edges_, config_.registration, search.T_found(),
                                      search.T_found(), scale, {config_.registration.iterations});
  if (!turned.solved || !search.Confirms(turned.T_oc)) return aligned;
  const auto plausible = [&](float explained, const PoseObjectFromCamera& T_oc) {
    return explained * (1.0F - AgreementWith(frame, T_oc).conflict());
  };
  const float turned_score = registration.ScoreOfAligned(field_, config_.registration, turned.T_oc);
  // Where it is now it has had the time to learn what it sees, at a turn that may be wrong.
  const float least = plausible(score, aligned.T_oc) - TurnSearch<Limits>::kScatter;
  if (plausible(turned_score, turned.T_oc) < least) return aligned;
  score = turned_score;
  turned.turned = true;
  return turned;
}

/// Along what it may have slid, the next places.
template <CapacityProfile Limits>
FreeShift Tracker<Limits>::NextFreeShift() noexcept {
  const Vec3 center_m = 0.5F * (field_.bounds_min_m() + field_.bounds_max_m());
  const float reach_m = 0.5F * (field_.bounds_max_m() - field_.bounds_min_m()).norm();
  // What is found explains more than half of what it would at the right place.
  const float step_m = 0.5F * config_.registration.match_radius_m;
  return slip_.Next(center_m, reach_m, step_m, ShiftSearch<Limits>::kPlaces);
}

/// The registered pose, or one that is shifted along what nothing held it in and explains more.
template <CapacityProfile Limits>
typename Tracker<Limits>::Aligned Tracker<Limits>::FindShift(Registration<Limits>& registration,
                                                             const Aligned& aligned,
                                                             RobustScale scale) noexcept {
  ShiftSearch<Limits> search(field_, model_edges_, config_.registration, registration.samples(),
                             edges_, aligned.T_oc, NextFreeShift());
  if (!search.Find()) return aligned;
  registration.UseKnownEdges(true);
  Aligned shifted = registration.Align(field_, model_edges_, config_.registration, search.T_found(),
                                       search.T_found(), scale, {config_.registration.iterations});
  registration.UseKnownEdges(false);
  if (!shifted.solved || !search.Confirms(shifted.T_oc)) return aligned;
  shifted.shifted = true;
  return shifted;
}

/// Whether a pose that was searched for is that of the same object frame by what is known of its
/// motion. Many things look alike from opposite sides: neither may the pose be turned far from the
/// predicted one, nor may the object have had the time to turn over since it was last seen. Of a
/// turn about an axis about which it looks alike nothing was known before, either.
template <CapacityProfile Limits>
bool Tracker<Limits>::IsSameObjectFrame(const DepthFrame& frame,
                                        const PoseObjectFromCamera& T_oc) const noexcept {
  constexpr float kReach_rad = 0.7F;
  constexpr float kFarthestTurn_rad = 1.6F;
  constexpr float kLongest_s = 0.6F;  // what is moved by hand has come to anything by then
  const float gap_s = Seconds(SpanNs(twist_filter_.stamp_ns(), frame.stamp_ns));
  float turned_rad = TurnBetween(T_oc_.rotation(), T_oc.rotation()).norm();
  float rate_rps = twist_filter_.twist().angular_rps.norm();
  if (free_axis_.Leaves(free_turn_o_)) {
    const Vec3 axis_o = AxisOf(free_axis_.mean()).direction;
    const Vec3 predicted_c = T_oc_.rotation().transpose() * axis_o;
    const Vec3 axis_c = T_oc.rotation().transpose() * axis_o;
    turned_rad = std::acos(std::clamp(predicted_c.dot(axis_c), -1.0F, 1.0F));
    rate_rps = twist_filter_.twist().angular_rps.cross(predicted_c).norm();
  }
  return gap_s <= kLongest_s && turned_rad <= kReach_rad && gap_s * rate_rps <= kFarthestTurn_rad;
}

}  // namespace disflow
