// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/camera_motion.h"

namespace disflow::host {

CameraMotion::CameraMotion(double target_distance_m, std::uint64_t seed)
    : target_distance_m_(target_distance_m) {
  RandomNumbers random(seed, 4);
  for (SmoothSignal& signal : signals_) signal = SmoothSignal(random, 0.25);
}

RigidState<World, Camera> CameraMotion::At(double time_s) const {
  // Metres for the position, radians for the roll.
  constexpr std::array<double, 4> kAmplitudes{0.05, 0.03, 0.03, 0.04};
  const double time = SoftStart::Time(time_s);
  std::array<double, 4> value{};
  std::array<double, 4> rate{};
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    value[i] = kAmplitudes[i] * (signals_[i].Value(time) - signals_[i].Value(0.0));
    rate[i] = kAmplitudes[i] * signals_[i].Rate(time) * SoftStart::Rate(time_s);
  }
  // Turned against the way it went, for small angles: the target stays in the image's centre.
  const Vec3d theta(value[1] / target_distance_m_, -value[0] / target_distance_m_, value[3]);
  const Vec3d theta_rate(rate[1] / target_distance_m_, -rate[0] / target_distance_m_, rate[3]);
  RigidState<World, Camera> state;
  state.pose = {ExpSo3(theta), Vec3d(value[0], value[1], value[2])};
  state.linear_mps = Vec3d(rate[0], rate[1], rate[2]);
  state.angular_rps = LeftJacobianSo3(theta) * theta_rate;
  return state;
}

}  // namespace disflow::host
