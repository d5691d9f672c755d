// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"

namespace disflow {

/// An object that was out of sight and may be anywhere since is believed to be found when two of
/// three frames in a row recognise it at the same place.
class Recognition {
 public:
  void Forget() noexcept { patience_ = 0; }
  /// The object was recognised a moment ago; T_oc() is where.
  [[nodiscard]] bool pending() const noexcept { return patience_ > 0; }
  [[nodiscard]] const PoseObjectFromCamera& T_oc() const noexcept { return T_oc_; }

  /// @param recognised Whether a frame's pose is beyond doubt.
  /// @param T_oc That pose.
  /// @param center_c A point of the object, camera frame.
  /// @return Whether that confirms what a frame before recognised.
  bool Confirm(bool recognised, const PoseObjectFromCamera& T_oc, const Vec3& center_c) noexcept {
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

 private:
  static constexpr int kPatience = 2;
  static constexpr float kSameTurn_rad = 0.35F;  ///< In a frame: 10 rad/s at 30 Hz.
  static constexpr float kSameShift_m = 0.05F;   ///< And 1.5 m/s.

  [[nodiscard]] bool IsNear(const PoseObjectFromCamera& T_oc, const Vec3& center_c) const noexcept {
    return (T_oc * center_c - T_oc_ * center_c).norm() < kSameShift_m &&
           TurnBetween(T_oc_.rotation(), T_oc.rotation()).norm() < kSameTurn_rad;
  }

  int patience_ = 0;  ///< Frames that may still confirm.
  PoseObjectFromCamera T_oc_;
};

}  // namespace disflow
