// SPDX-License-Identifier: BSD-3-Clause
#include "leaving_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace disflow::host {

using std::numbers::pi;

LeavingMotion::LeavingMotion(const MotionSettings& settings)
    : start_m_(settings.workspace.centre_m), start_rotation_(settings.start_rotation) {}

RigidState<World, Object> LeavingMotion::At(double time_s) const {
  constexpr double kStart_s = 0.5;
  constexpr double kPeriod_s = 2.4;
  constexpr double kWay_m = 0.62;  // beyond the border of the usual view
  constexpr double kTurn_rps = 0.35;
  const double x = std::clamp((time_s - kStart_s) / kPeriod_s, 0.0, 1.0);
  RigidState<World, Object> state;
  state.angular_rps = Vec3d(0.0, kTurn_rps, 0.0);
  state.pose = {Mat3d(ExpSo3(Vec3d(0.0, kTurn_rps * time_s, 0.0)) * start_rotation_),
                Vec3d(start_m_ + Vec3d(0.5 * kWay_m * (1.0 - std::cos(2.0 * pi * x)), 0.0, 0.0))};
  if (x > 0.0 && x < 1.0) state.linear_mps.x() = kWay_m * pi / kPeriod_s * std::sin(2.0 * pi * x);
  return state;
}

}  // namespace disflow::host
