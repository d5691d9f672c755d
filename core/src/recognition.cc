// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/recognition.h"

namespace disflow {
namespace {

constexpr int kPatience = 2;
constexpr float kSameTurn_rad = 0.35F;  // in a frame: 10 rad/s at 30 Hz
constexpr float kSameShift_m = 0.05F;   // and 1.5 m/s

}  // namespace

bool Recognition::Confirm(bool recognised, const PoseObjectFromCamera& T_oc,
                          const Vec3& center_c) noexcept {
  const bool same = pending() && IsNear(T_oc, center_c);
  if (recognised && same) {
    Forget();
    return true;
  }
  if (recognised) {
    patience_ = kPatience;
  } else if (patience_ > 0) {
    --patience_;
  }
  // The object may move on while it is looked at.
  if (recognised || same) T_oc_ = T_oc;
  return false;
}

bool Recognition::IsNear(const PoseObjectFromCamera& T_oc, const Vec3& center_c) const noexcept {
  return (T_oc * center_c - T_oc_ * center_c).norm() < kSameShift_m &&
         TurnBetween(T_oc_.rotation(), T_oc.rotation()).norm() < kSameTurn_rad;
}

}  // namespace disflow
