// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/free_axis.h"

#include <algorithm>

namespace disflow {
namespace {

// The surface beside an axis is learnt in a second of turning; longer averages would hold on to
// what was wrong before.
constexpr int kMostFrames = 30;
constexpr int kFewestFrames = 10;
// cos^2 of 18 degrees between directions of turns.
constexpr float kSame = 0.9F;

Mat3 Turns(const Mat6& motion) noexcept { return motion.bottomRightCorner<3, 3>(); }

}  // namespace

bool FreeAxis::IsSame(const Mat6& free_turn) const noexcept {
  const Mat3 mean = Turns(mean_);
  const Mat3 by_frame = Turns(free_turn);
  return frames_ > 0 && mean.cwiseProduct(by_frame).sum() > kSame * mean.norm() * by_frame.norm();
}

void FreeAxis::Learn(const Mat6& free_turn) noexcept {
  if (free_turn.isZero(0.0F) || !free_turn.allFinite()) return;
  if (!IsSame(free_turn)) {
    if (Leaves(free_turn)) return;
    frames_ = 0;
  }
  frames_ = std::min(frames_ + 1, kMostFrames);
  if (frames_ == 1) mean_ = free_turn;
  mean_ += (free_turn - mean_) / static_cast<float>(frames_);
}

Mat6 FreeAxis::Steadied(const Mat6& free_turn) const noexcept {
  return frames_ >= kFewestFrames && IsSame(free_turn) ? mean_ : free_turn;
}

bool FreeAxis::IsKnown() const noexcept {
  // Of turns about one axis the norm is the trace; about two alike it is 0.7 of it.
  const Mat3 mean = Turns(mean_);
  return frames_ >= kFewestFrames && mean.norm() > kSame * mean.trace();
}

bool FreeAxis::IsOne(const Mat6& free_turn) const noexcept {
  return IsKnown() && IsSame(free_turn);
}

bool FreeAxis::Leaves(const Mat6& free_turn) const noexcept {
  const Mat3 mean = Turns(mean_);
  const float about_axis = mean.cwiseProduct(Turns(free_turn)).sum();
  return IsKnown() && (IsSame(free_turn) || about_axis > kSame * mean.squaredNorm());
}

}  // namespace disflow
