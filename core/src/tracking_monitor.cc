// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/tracking_monitor.h"

#include <algorithm>
#include <cmath>

namespace disflow {
namespace {

// Standard deviations at which a pose is worth half: a gripper's tolerance.
constexpr float kPositionStdHalf_m = 0.005F;
constexpr float kRotationStdHalf_rad = 0.05F;
constexpr float kMinInlierShare = 0.15F;
// Of what is usual for this object and sensor: of a pose that was followed and is as usual in all
// else, since how many residuals there are within their noise is decided by how well that is known;
// and after a loss.
constexpr float kMinFollowedShare = 0.33F;
constexpr float kMinRecoveredShare = 0.55F;
// Likewise, for a pose that may be any; of other poses of mugs and bottles those that come nearest
// reach 0.94 of the usual score, or contradict the model by 0.03 more than usual in one of two
// frames.
constexpr float kRecognisedShare = 0.95F;
constexpr float kSuspectedShare = 0.9F;
constexpr float kRecognisedInlierShare = 0.6F;
constexpr float kRecognisedConflict = 0.03F;  // of some forty points in view one is off by chance
constexpr float kRecognisedVisible =
    0.4F;  ///< Of the model's front: less may be a part of anything.
// More than usual, of a pose that has slid along the object: four of some forty points in view.
constexpr float kSlidConflict = 0.1F;
// What is usual follows the frames with a time constant of 20: two thirds of a second at 30 Hz.
constexpr float kUsualGain = 0.05F;

float InlierShare(const TrackingMonitor::Evidence& evidence) noexcept {
  return static_cast<float>(evidence.inliers) / static_cast<float>(std::max(evidence.points, 1));
}

}  // namespace

void TrackingMonitor::Start(const MonitorConfig& config, StampNs stamp_ns) noexcept {
  config_ = config;
  state_ = TrackingState::kInitialising;
  quality_ = 50;
  frames_in_state_ = 0;
  missed_ = 0;
  searched_ = 0;
  searched_ns_ = 0;
  updated_ns_ = stamp_ns;
  last_registered_ns_ = stamp_ns;
  usual_ = {};
  contradicted_ = false;
  confirmed_ = false;
}

bool TrackingMonitor::Accepts(const Evidence& evidence, StampNs stamp_ns) const noexcept {
  if (!evidence.registered) return false;
  const bool usual_conflict =
      evidence.resolved_conflict <= config_.degraded_conflict + usual_.conflict;
  if (Doubts(stamp_ns)) return Explains(evidence) && usual_conflict;
  const bool sound = evidence.score >= config_.lost_score &&
                     evidence.resolved_conflict <= config_.lost_conflict &&
                     InlierShare(evidence) >= kMinInlierShare;
  return sound || (ExplainsUsually(evidence, kMinFollowedShare) && usual_conflict);
}

bool TrackingMonitor::Explains(const Evidence& evidence) const noexcept {
  return ExplainsUsually(evidence, kMinRecoveredShare);
}

/// A noisy sensor never shows what a good one does: the bar is what was usual before.
bool TrackingMonitor::ExplainsUsually(const Evidence& evidence, float inliers) const noexcept {
  return evidence.score >= config_.recovered_score * usual_.score &&
         InlierShare(evidence) >= inliers * usual_.inlier_share;
}

void TrackingMonitor::Usual::Follow(const Evidence& evidence) noexcept {
  score += kUsualGain * (evidence.score - score);
  conflict += kUsualGain * (evidence.conflict - conflict);
  inlier_share += kUsualGain * (std::min(InlierShare(evidence), 1.0F) - inlier_share);
}

/// Tracking means: three standard deviations are within 2 cm and 10 degrees.
bool TrackingMonitor::Trusts(const Evidence& evidence) const noexcept {
  return evidence.score >= config_.degraded_score &&
         evidence.conflict <= config_.degraded_conflict &&
         evidence.position_std_m <= config_.degraded_std_m &&
         evidence.rotation_std_rad <= config_.degraded_std_rad;
}

std::uint8_t TrackingMonitor::Grade(const Evidence& evidence) const noexcept {
  const float position = 1.0F / (1.0F + evidence.position_std_m / kPositionStdHalf_m);
  const float rotation = 1.0F / (1.0F + evidence.rotation_std_rad / kRotationStdHalf_rad);
  const float grade = 100.0F *
                      std::clamp(evidence.score * (1.0F - 2.0F * evidence.conflict), 0.0F, 1.0F) *
                      std::sqrt(position * rotation);
  return static_cast<std::uint8_t>(std::clamp(std::lround(grade), 1L, 100L));
}

void TrackingMonitor::Update(const Evidence& evidence, StampNs stamp_ns) noexcept {
  const TrackingState before = state_;
  const StampNs passed_ns = SpanNs(updated_ns_, stamp_ns);
  updated_ns_ = stamp_ns;
  contradicted_ =
      evidence.registered && evidence.resolved_conflict > usual_.conflict + kSlidConflict;
  if (!evidence.registered) {
    ++missed_;
    if (evidence.in_view) {
      if (searched_ > 0) searched_ns_ += passed_ns;
      ++searched_;
    }
    quality_ = static_cast<std::uint8_t>(quality_ / 2);
    if (missed_ >= config_.lost_after_frames) {
      state_ = TrackingState::kLost;
      quality_ = 0;
    } else if (state_ != TrackingState::kLost) {
      state_ = TrackingState::kDegraded;
    }
  } else {
    if (!Doubts(stamp_ns)) usual_.Follow(evidence);
    confirmed_ = true;
    missed_ = 0;
    searched_ = 0;
    searched_ns_ = 0;
    last_registered_ns_ = stamp_ns;
    quality_ = Grade(evidence);
    state_ = AfterRegistered(evidence);
  }
  frames_in_state_ = state_ == before ? frames_in_state_ + 1 : 0;
}

TrackingState TrackingMonitor::AfterRegistered(const Evidence& evidence) const noexcept {
  switch (state_) {
    case TrackingState::kLost:
      return TrackingState::kRecovered;
    case TrackingState::kInitialising:
      if (frames_in_state_ + 1 < kInitialFrames) return state_;
      break;
    case TrackingState::kRecovered:
      if (frames_in_state_ + 1 < kRecoveryFrames) return state_;
      break;
    case TrackingState::kTracking:
    case TrackingState::kDegraded:
      break;
  }
  return Trusts(evidence) ? TrackingState::kTracking : TrackingState::kDegraded;
}

bool TrackingMonitor::Recognises(const Evidence& evidence) const noexcept {
  return evidence.registered && evidence.score >= kRecognisedShare * usual_.score &&
         InlierShare(evidence) >= kRecognisedInlierShare * usual_.inlier_share &&
         evidence.conflict <= usual_.conflict + kRecognisedConflict &&
         evidence.visible >= kRecognisedVisible &&
         evidence.position_to_model_std_m <= config_.degraded_std_m &&
         evidence.rotation_to_model_std_rad <= config_.degraded_std_rad;
}

bool TrackingMonitor::Suspects(const Evidence& evidence) const noexcept {
  return evidence.registered && evidence.score >= kSuspectedShare * usual_.score &&
         evidence.conflict <= usual_.conflict + 2.0F * kRecognisedConflict &&
         evidence.visible >= kRecognisedVisible;
}

bool TrackingMonitor::ShouldRestart() const noexcept {
  const bool in_vain = !confirmed_ || Seconds(searched_ns_) > config_.reinitialise_after_s;
  return state_ == TrackingState::kLost && in_vain;
}

}  // namespace disflow
