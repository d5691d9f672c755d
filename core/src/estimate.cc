// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/estimate.h"

#include <limits>

#include "disflow/saturating.h"

namespace disflow {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool IsFinite(const Estimate& estimate) noexcept {
  return estimate.T_co.IsFinite() && estimate.twist.linear_mps.allFinite() &&
         estimate.twist.angular_rps.allFinite() && (!estimate.has_T_wo || estimate.T_wo.IsFinite());
}

/// Whether the pose belongs to the frame's stamp at all.
bool IsForStamp(const Estimate& estimate) noexcept {
  // A stamp that does not increase has been answered before; of a frame that could not be read
  // none is known.
  const bool is_of_device = estimate.status >= Status::kInvalidUri;
  const bool has_model = estimate.pose_covariance.diagonal().maxCoeff() > 0.0F;
  return has_model && !is_of_device && estimate.status != Status::kStampNotIncreasing;
}

}  // namespace

EstimateKind KindOf(const Estimate& estimate) noexcept {
  if (!IsFinite(estimate)) return EstimateKind::kRefused;
  if (estimate.status != Status::kOk && !IsForStamp(estimate)) return EstimateKind::kRefused;
  const bool measured = estimate.status == Status::kOk && estimate.state != TrackingState::kLost;
  return measured ? EstimateKind::kMeasured : EstimateKind::kPredicted;
}

Estimate Published(const Estimate& estimate) noexcept {
  Estimate published = estimate;
  if (KindOf(estimate) != EstimateKind::kRefused) return published;
  const Vec3 nowhere = Vec3::Constant(kNaN);
  published.T_co = {Mat3(Mat3::Constant(kNaN)), nowhere};
  published.has_T_wo = false;
  published.T_wo = {};
  published.twist = {nowhere, nowhere};
  published.pose_covariance.setConstant(kNaN);
  published.twist_covariance.setConstant(kNaN);
  published.weak = {};
  published.quality = 0;
  return published;
}

const char* Name(EstimateKind kind) noexcept {
  switch (kind) {
    case EstimateKind::kMeasured:
      return "measured";
    case EstimateKind::kPredicted:
      return "predicted";
    case EstimateKind::kRefused:
      return "refused";
  }
  return "unknown";
}

const char* Name(TrackingState state) noexcept {
  switch (state) {
    case TrackingState::kInitialising:
      return "initialising";
    case TrackingState::kTracking:
      return "tracking";
    case TrackingState::kDegraded:
      return "degraded";
    case TrackingState::kLost:
      return "lost";
    case TrackingState::kRecovered:
      return "recovered";
  }
  return "unknown";
}

const char* Name(Stage stage) noexcept {
  switch (stage) {
    case Stage::kSegment:
      return "segment";
    case Stage::kSample:
      return "sample";
    case Stage::kRegister:
      return "register";
    case Stage::kFilter:
      return "filter";
    case Stage::kFuse:
      return "fuse";
    case Stage::kRetrain:
      return "retrain";
  }
  return "unknown";
}

const char* Name(WeakKind kind) noexcept {
  switch (kind) {
    case WeakKind::kNone:
      return "none";
    case WeakKind::kTranslation:
      return "translation";
    case WeakKind::kRotation:
      return "rotation";
  }
  return "unknown";
}

void Counters::Accumulate(const Counters& other) noexcept {
  AddSaturating(frames, other.frames);
  AddSaturating(frames_rejected, other.frames_rejected);
  AddSaturating(frames_unregistered, other.frames_unregistered);
  AddSaturating(images_repeated, other.images_repeated);
  AddSaturating(pixels_out_of_range, other.pixels_out_of_range);
  AddSaturating(runs_dropped, other.runs_dropped);
  AddSaturating(blocks_sparse, other.blocks_sparse);
  AddSaturating(blocks_grazing, other.blocks_grazing);
  AddSaturating(blocks_flying, other.blocks_flying);
  AddSaturating(samples_dropped, other.samples_dropped);
  AddSaturating(residuals_unmatched, other.residuals_unmatched);
  AddSaturating(residuals_truncated, other.residuals_truncated);
  AddSaturating(residuals_normal_mismatch, other.residuals_normal_mismatch);
  AddSaturating(observations_rejected, other.observations_rejected);
  AddSaturating(observations_out_of_bounds, other.observations_out_of_bounds);
  AddSaturating(samples_refused, other.samples_refused);
  AddSaturating(clusters_evicted, other.clusters_evicted);
  AddSaturating(clusters_forgotten, other.clusters_forgotten);
  AddSaturating(edges_refused, other.edges_refused);
  AddSaturating(candidates_dropped, other.candidates_dropped);
}

}  // namespace disflow
