// SPDX-License-Identifier: BSD-3-Clause
#include "turn_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "disflow/host/random.h"

namespace disflow::host {

using std::numbers::pi;

TurnMotion::TurnMotion(const MotionSettings& settings)
    : workspace_(settings.workspace),
      start_rotation_(settings.start_rotation),
      duration_s_(0.9 * settings.duration_s) {
  RandomNumbers random(settings.seed, 2);
  constexpr double kTilt = 0.15;
  axis_ = Vec3d(random.Uniform(-kTilt, kTilt), random.Bits() % 2 == 0 ? 1.0 : -1.0,
                random.Uniform(-kTilt, kTilt))
              .normalized();
  constexpr double kWander_m = 0.06;
  for (int i = 0; i < 3; ++i) {
    const double reach_m = std::min(kWander_m, 0.5 * workspace_.half_extent_m[i]);
    wander_m_[i] = random.Uniform(0.5, 1.0) * (random.Bits() % 2 == 0 ? reach_m : -reach_m);
  }
}

RigidState<World, Object> TurnMotion::At(double time_s) const {
  // Smooth step with continuous curvature from 0 to 1.
  const double x = std::clamp(time_s / duration_s_, 0.0, 1.0);
  const double share = x * x * x * (10.0 + x * (6.0 * x - 15.0));
  const double share_rate = 30.0 * x * x * (1.0 - x) * (1.0 - x) / duration_s_;
  RigidState<World, Object> state;
  state.angular_rps = axis_ * (2.0 * pi * share_rate);
  Vec3d position = workspace_.centre_m;
  for (int i = 0; i < 3; ++i) {
    // One period along x, two along y, three along z: a closed curve that crosses the centre.
    const double turns = 2.0 * pi * (i + 1);
    position[i] += wander_m_[i] * std::sin(turns * share);
    state.linear_mps[i] = wander_m_[i] * std::cos(turns * share) * turns * share_rate;
  }
  const Mat3d turn = ExpSo3(Vec3d(axis_ * (2.0 * pi * share)));
  state.pose = {Mat3d(turn * start_rotation_), position};
  return state;
}

}  // namespace disflow::host
