// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/depth/depth_reader.h"
#include "disflow/flow/model_agreement.h"
#include "disflow/memory/every_nth.h"
#include "disflow/tracker.h"

/// @file
/// Definitions of those members of Tracker that make observations a part of the model, and that
/// forget what was none of the object's; see tracker_impl.h.

namespace disflow {

/// Whether a point lies in space that the camera has looked through.
template <CapacityProfile Limits>
bool Tracker<Limits>::IsForeign(const Vec3& x_o) const noexcept {
  return seen_.IsFree(x_o, config_.segmenter.free_margin_m);
}

/// All that is seen is the object: it is around the camera, and no body of which a part is seen.
template <CapacityProfile Limits>
bool Tracker<Limits>::IsRoom(const DepthFrame& frame) const noexcept {
  return !frame.mask.given() && config_.segmenter.grow_region == 0;
}

/// As coarse as the object in its first view asks for.
template <CapacityProfile Limits>
void Tracker<Limits>::StartField(const DepthFrame& frame) noexcept {
  float squared_depths_m2 = 0.0F;
  for (const SurfaceSample& sample : samples_) {
    squared_depths_m2 += sample.position_m.z() * sample.position_m.z();
  }
  const float pixel_m2 = squared_depths_m2 / static_cast<float>(samples_.size()) /
                         (frame.camera.fx_px * frame.camera.fy_px);
  const float seen_m2 = static_cast<float>(object_mask_.count()) * pixel_m2;
  const float coarseness =
      IsRoom(frame) ? 1.0F : CoarsenessFor(seen_m2, Limits::kMaxClusters, config_);
  field_.Start(config_.field, coarseness);
}

template <CapacityProfile Limits>
void Tracker<Limits>::RememberView(const DepthFrame& frame) noexcept {
  if (IsRoom(frame) || config_.segmenter.free_margin_m == 0.0F) return;
  constexpr float kFarthest_m = 60.0F;
  seen_.Add(DepthReader(frame.depth, config_.segmenter.min_range_m, kFarthest_m), frame.camera,
            T_oc_, object_mask_.box());
}

/// Surface that was learnt though it was not the object's, such as a piece of the table under a
/// loose mask, stays behind when the object moves: then it is looked through. What a sensor made up
/// along an outline is not observed again.
template <CapacityProfile Limits>
void Tracker<Limits>::ForgetContradicted(const DepthFrame& frame, const PoseObjectFromCamera& T_oc,
                                         Estimate& estimate) noexcept {
  Handles forgotten;
  const bool turn_free = IsTurnFree(frame.stamp_ns);
  (void)CompareWithImage(field_, T_oc, frame.camera, UsableDepth(frame),
                         [&](Handle handle, bool seen) {
                           // At a turn or place that may be wrong nothing contradicts what was
                           // known.
                           const auto& cluster = field_.store()[handle];
                           if (turn_free && !cluster.turn_free) return;
                           if (slip_.free() && !cluster.shift_free) return;
                           if (field_.Witness(handle, seen)) (void)forgotten.push_back(handle);
                         });
  Forget(forgotten, estimate);
  field_.ForEachUnconfirmed(frame_index_,
                            [&](Handle handle) { (void)forgotten.push_back(handle); });
  Forget(forgotten, estimate);
}

/// Empties the list: the field must not change while it is looked through.
template <CapacityProfile Limits>
void Tracker<Limits>::Forget(Handles& forgotten, Estimate& estimate) noexcept {
  for (const Handle handle : forgotten) field_.Forget(handle, estimate.rejected);
  forgotten.clear();
}

/// @param marked marked(cluster): whether it is forgotten.
template <CapacityProfile Limits>
template <class Marked>
void Tracker<Limits>::ForgetAll(const Marked& marked, Estimate& estimate) noexcept {
  bool more = true;
  while (more) {
    Handles forgotten;
    field_.store().ForEach([&](Handle handle, const auto& cluster) {
      if (marked(cluster)) (void)forgotten.push_back(handle);
    });
    more = forgotten.full();
    Forget(forgotten, estimate);
  }
}

/// Surface that was found while nothing told the turn lies elsewhere about the axis, once the turn
/// is found: a mug would have two handles.
template <CapacityProfile Limits>
void Tracker<Limits>::ForgetFoundTurnFree(Estimate& estimate) noexcept {
  ForgetAll([](const auto& cluster) { return cluster.turn_free; }, estimate);
}

/// The same of what was found while it may have slid: a box would have two lids.
template <CapacityProfile Limits>
void Tracker<Limits>::ForgetFoundShiftFree(Estimate& estimate) noexcept {
  model_edges_.ForgetFoundShiftFree();
  ForgetAll([](const auto& cluster) { return cluster.shift_free; }, estimate);
}

/// Whether what a pixel shows may go on as something else: no new surface is taken from there.
template <CapacityProfile Limits>
bool Tracker<Limits>::MayGoOn(const PixelAt& px, const DepthFrame& frame) const noexcept {
  return contact_.merged || overrun_.IsReachedFrom(px.u, px.v, UsableDepth(frame), frame.camera);
}

/// A thin thing that lies on a table: next to none of it is farther from where its surface goes on
/// than the mask's outline may be off. Of the mask nothing would be certain.
template <CapacityProfile Limits>
bool Tracker<Limits>::IsThinnerThanTolerance(const DepthFrame& frame) const noexcept {
  int certain = 0;
  for (const SurfaceSample& sample : samples_)
    certain += int{!MayGoOn(PixelAt(frame.camera.Project(sample.position_m)), frame)};
  return certain < config_.monitor.min_samples;
}

template <CapacityProfile Limits>
void Tracker<Limits>::FuseObservations(const DepthFrame& frame, Estimate& estimate) noexcept {
  const bool first = frame_index_ == 0;
  const EveryNth some(samples_, first ? samples_.size() : config_.field.fuse_budget, frame_index_);
  const Mat3& R_oc = T_oc_.rotation();
  // Then the mask is taken at its word, or there would be no model.
  const bool by_mask = first && IsThinnerThanTolerance(frame);
  int decided = 0;
  for (int i = 0; i < some.size(); ++i) {
    SurfaceSample observation = some[i];
    const PixelAt px(frame.camera.Project(observation.position_m));
    const bool undecided = by_mask ? !frame.mask.Test(px.u, px.v) : MayGoOn(px, frame);
    decided += int{!undecided};
    observation.position_m = T_oc_ * observation.position_m;
    observation.normal = R_oc * observation.normal;
    if (IsForeign(observation.position_m)) {
      ++estimate.rejected.observations_rejected;
      continue;
    }
    // The outcome is in the counters.
    (void)field_.Insert(observation, frame_index_, estimate.rejected, !undecided);
  }
  if (first) monitor_.Expect(static_cast<float>(decided) / static_cast<float>(some.size()));
  for (const EdgePoint& point : edges_) {
    const EdgePoint moved = T_oc_ * point;
    if (IsForeign(moved.position_m)) continue;
    model_edges_.Insert(moved, field_.config().merge_radius_m, frame_index_, estimate.rejected);
  }
}

template <CapacityProfile Limits>
void Tracker<Limits>::Retrain(Estimate& estimate) noexcept {
  const int factor = frame_index_ < kInitialFrames ? kInitialBudgetFactor : 1;
  (void)field_.Retrain(factor * config_.field.retrain_budget, estimate.rejected);
  ++frame_index_;
}

}  // namespace disflow
