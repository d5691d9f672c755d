// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/occluding_arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "disflow/host/object_meshes.h"
#include "disflow/host/random.h"

namespace disflow::host {

OccludingArm::OccludingArm(double object_radius_m, std::uint64_t seed)
    : object_radius_m_(object_radius_m) {
  RandomNumbers random(seed, 7);
  sweep_rps_ = 2.0 * std::numbers::pi * random.Uniform(0.22, 0.32);
  lean_rad_ = random.Uniform(-0.3, 0.3);
  radius_m_ = 0.4 * object_radius_m;
  mesh_ = MakeCapsule(radius_m_, 1.0);
}

Transform<Camera, Object, double> OccludingArm::PoseAt(
    double time_s, const Transform<Camera, Object, double>& T_co) const {
  const Vec3d& object = T_co.translation();
  constexpr double kSweepRadii = 2.4;
  constexpr double kGap_m = 0.02;
  const double aside_m = kSweepRadii * object_radius_m_ * std::cos(sweep_rps_ * time_s);
  // The tip reaches the object's middle: whatever the object's attitude, about half stays free.
  const double depth_m = std::max(0.2, object.z() - object_radius_m_ - radius_m_ - kGap_m);
  const Vec3d tip = (object + Vec3d(aside_m, 0.0, 0.0)) * (depth_m / object.z());
  Mat3d upright;
  upright << 1, 0, 0, 0, 0, -1, 0, 1, 0;  // the capsule's +z is the camera's up
  return {Mat3d(ExpSo3(Vec3d(0.0, 0.0, lean_rad_)) * upright), tip};
}

}  // namespace disflow::host
