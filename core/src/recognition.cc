// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/recognition.h"

#include "disflow/saturating.h"

namespace disflow {
namespace {

constexpr int kPatience = 2;
// As fast as things move by hand.
constexpr float kFastest_rps = 10.0F;
constexpr float kFastest_mps = 1.5F;

}  // namespace

void Recognition::Forget() noexcept {
  patience_ = 0;
  suspected_ = false;
}

void Recognition::Consider(bool nearly, const PoseObjectFromCamera& T_oc) noexcept {
  suspected_ = nearly && !suspected_ && !pending();
  if (suspected_) T_oc_ = T_oc;
}

bool Recognition::Confirm(bool recognised, const PoseObjectFromCamera& T_oc, const Vec3& center_c,
                          StampNs stamp_ns) noexcept {
  const bool same = pending() && IsNear(T_oc, center_c, Seconds(SpanNs(stamp_ns_, stamp_ns)));
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
  if (recognised || same) {
    T_oc_ = T_oc;
    stamp_ns_ = stamp_ns;
  }
  return false;
}

bool Recognition::IsNear(const PoseObjectFromCamera& T_oc, const Vec3& center_c,
                         float since_s) const noexcept {
  return (T_oc * center_c - T_oc_ * center_c).norm() < kFastest_mps * since_s &&
         TurnBetween(T_oc_.rotation(), T_oc.rotation()).norm() < kFastest_rps * since_s;
}

}  // namespace disflow
