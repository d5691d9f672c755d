// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// An object that was out of sight and may be anywhere since is believed to be found when two of
/// three frames in a row recognise it at the same place.
class Recognition {
 public:
  void Forget() noexcept;
  /// The object was recognised a moment ago; T_oc() is where.
  [[nodiscard]] bool pending() const noexcept { return patience_ > 0; }
  [[nodiscard]] const PoseObjectFromCamera& T_oc() const noexcept { return T_oc_; }

  /// T_oc() is what a frame shows nearly: the object may be turned over.
  [[nodiscard]] bool suspected() const noexcept { return suspected_; }
  /// A frame's pose that is nearly recognised is looked at once more in the next frame, and not
  /// again in the one after it.
  void Consider(bool nearly, const PoseObjectFromCamera& T_oc) noexcept;

  /// @param recognised Whether a frame's pose is beyond doubt.
  /// @param T_oc That pose.
  /// @param center_c A point of the object, camera frame.
  /// @return Whether that confirms what a frame before recognised.
  bool Confirm(bool recognised, const PoseObjectFromCamera& T_oc, const Vec3& center_c,
               StampNs stamp_ns) noexcept;

 private:
  /// Whether an object may have moved so far since T_oc().
  [[nodiscard]] bool IsNear(const PoseObjectFromCamera& T_oc, const Vec3& center_c,
                            float since_s) const noexcept;

  int patience_ = 0;  ///< Frames that may still confirm.
  bool suspected_ = false;
  PoseObjectFromCamera T_oc_;
  StampNs stamp_ns_ = 0;  ///< Of T_oc_.
};

}  // namespace disflow
