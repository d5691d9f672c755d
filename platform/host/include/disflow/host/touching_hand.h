// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/host/rigid_state.h"
#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// A hand that comes from the right, touches the object, moves along with it and leaves again. What
/// it touches it does not hide.
class TouchingHand {
 public:
  /// @param start_rotation Object in the camera frame, first frame.
  TouchingHand(const TriangleMesh& object, const Mat3d& start_rotation);

  [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
  /// @param T_co The object.
  [[nodiscard]] Transform<Camera, Object, double> PoseAt(
      double time_s, const Transform<Camera, Object, double>& T_co) const;

  static constexpr double kTouch_s = 1.0;    ///< First contact.
  static constexpr double kRelease_s = 3.0;  ///< Last contact.

 private:
  TriangleMesh mesh_;
  Mat3d rotation_;  ///< Hand in the object frame.
  Vec3d touch_m_;   ///< The fingertip in contact, object frame.
  Vec3d outward_;   ///< From there into the hand, object frame.
};

}  // namespace disflow::host
