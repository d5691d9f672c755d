// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/touching_hand.h"

#include <algorithm>

#include "disflow/host/object_meshes.h"

namespace disflow::host {

TouchingHand::TouchingHand(const TriangleMesh& object, const Mat3d& start_rotation)
    : outward_(start_rotation.transpose() * Vec3d::UnitX()) {
  constexpr double kRadius_m = 0.025;
  constexpr double kLength_m = 0.6;
  mesh_ = MakeCapsule(kRadius_m, kLength_m);
  double farthest_m = 0.0;
  for (const Vec3d& vertex : object.vertices)
    farthest_m = std::max(farthest_m, vertex.dot(outward_));
  touch_m_ = farthest_m * outward_;
  // The capsule lies along its -z.
  rotation_ =
      Eigen::Quaterniond::FromTwoVectors(Vec3d(-Vec3d::UnitZ()), outward_).toRotationMatrix();
}

Transform<Camera, Object, double> TouchingHand::PoseAt(
    double time_s, const Transform<Camera, Object, double>& T_co) const {
  constexpr double kSpeed_mps = 0.4;
  const double away_s = std::max({kTouch_s - time_s, time_s - kRelease_s, 0.0});
  const Vec3d tip = touch_m_ + kSpeed_mps * away_s * outward_;
  return T_co * Transform<Object, Object, double>(rotation_, tip);
}

}  // namespace disflow::host
