// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/estimate.h"

#include <limits>

namespace disflow {
namespace {

void AddSaturating(std::uint32_t& total, std::uint32_t more) noexcept {
  constexpr std::uint32_t kMax = std::numeric_limits<std::uint32_t>::max();
  total = more > kMax - total ? kMax : total + more;
}

}  // namespace

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
  AddSaturating(edges_refused, other.edges_refused);
}

}  // namespace disflow
