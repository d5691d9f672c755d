// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/place_slip.h"

#include <algorithm>
#include <cmath>

#include "disflow/flow/pose_start.h"
#include "disflow/geometry/covariance.h"

namespace disflow {

Vec3 FreeShift::Place(int i, int places) const noexcept {
  const int ring = (part * places + i) / 2 + 1;
  return (i % 2 == 0 ? step_m : -step_m) * static_cast<float>(ring) * direction;
}

void PlaceSlip::Start(StampNs stamp_ns) noexcept {
  End();
  held_ns_ = stamp_ns;
}

void PlaceSlip::End() noexcept {
  free_ = false;
  covariance_o_.setZero();
  sliding_frames_ = 0;
  known_frames_ = 0;
  part_ = 0;
}

Mat6 PlaceSlip::Covariance(const Mat6& free_o, float slid_s) const noexcept {
  if (free_o.isZero(0.0F)) return covariance_o_;
  const auto frames = static_cast<float>(sliding_frames_);
  return covariance_o_ + slid_s * slid_s / (frames + 1.0F) * (frames * free_o_ + free_o);
}

void PlaceSlip::Learn(StampNs stamp_ns, bool unheld, const Mat6& free_o, float slid_s,
                      bool by_known) noexcept {
  // In which an object may move by several times what an edge is found within.
  constexpr float kForgotten_s = 0.1F;
  // One frame that seems to tell does not.
  constexpr int kFramesUntilKnown = 3;
  if (unheld) {
    free_ = free_ || Seconds(SpanNs(held_ns_, stamp_ns)) > kForgotten_s;
    if (sliding_frames_ == 0) free_o_.setZero();
    constexpr int kMostFrames = 1000;  // what more of them tell is nothing
    sliding_frames_ = std::min(sliding_frames_ + 1, kMostFrames);
    free_o_ += (free_o - free_o_) / static_cast<float>(sliding_frames_);
    slid_s_ = slid_s;
  } else {
    held_ns_ = stamp_ns;
    if (free_ && sliding_frames_ > 0) covariance_o_ += slid_s_ * slid_s_ * free_o_;
    sliding_frames_ = 0;
  }
  known_frames_ = free_ && by_known ? known_frames_ + 1 : 0;
  if (known_frames_ == kFramesUntilKnown) End();
}

FreeShift PlaceSlip::Next(const Vec3& center_m, float reach_m, float step_m, int places) noexcept {
  Mat6 slid_o = covariance_o_;
  if (sliding_frames_ > 0) slid_o += slid_s_ * slid_s_ * free_o_;
  const Mat6 at_center = CovarianceAtPoint(slid_o, Mat3::Identity(), center_m);
  const LongestAxis slide(at_center.topLeftCorner<3, 3>());
  FreeShift shift;
  shift.direction = slide.direction;
  shift.step_m = step_m;
  const float farthest_m = std::min(reach_m, std::sqrt(std::max(slide.variance, 0.0F)));
  const int parts = 1 + static_cast<int>(2.0F * farthest_m / step_m) / places;
  shift.part = part_++ % parts;
  return shift;
}

}  // namespace disflow
