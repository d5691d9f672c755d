// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"

/// @file
/// Double-precision geometry of the evaluation. The tracker's object frame (`Object`) and the
/// ground truth's (`TrueObject`) are different types, so that they cannot be mixed up.

namespace disflow::apps {

using Vec3d = Mat<double, 3>;
using Vec6d = Mat<double, 6>;
using Mat3d = Mat<double, 3, 3>;
using Mat6d = Mat<double, 6, 6>;

struct TrueObject {};  ///< The object frame of ground truth and of the model.

using EstimatedPose = Transform<Camera, Object, double>;       ///< T_co as the tracker reports it.
using TruePose = Transform<Camera, TrueObject, double>;        ///< T_ct, object in camera.
using ObjectFromTrue = Transform<Object, TrueObject, double>;  ///< T_ot, fixed by the alignment.

/// Velocity in camera axes of one point of a moving body.
struct PointTwist {
  Vec3d linear_mps = Vec3d::Zero();
  Vec3d angular_rps = Vec3d::Zero();
};

/// The same motion seen at a point that lies `offset_m` from the first (camera axes).
[[nodiscard]] inline PointTwist MoveTo(const PointTwist& twist, const Vec3d& offset_m) {
  return {twist.linear_mps + twist.angular_rps.cross(offset_m), twist.angular_rps};
}

}  // namespace disflow::apps
