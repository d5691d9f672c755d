// SPDX-License-Identifier: BSD-3-Clause
#include "smooth_motion.h"

#include <algorithm>

namespace disflow::host {
namespace {

MotionPeaks MeasurePeaks(const ObjectMotion& motion) {
  constexpr double kWindow_s = 10.0;
  constexpr double kStep_s = 0.004;
  MotionPeaks peaks{0.0, 0.0};
  for (int i = 0; i * kStep_s < kWindow_s; ++i) {
    const auto state = motion.At(i * kStep_s);
    peaks.linear_mps = std::max(peaks.linear_mps, state.linear_mps.norm());
    peaks.angular_rps = std::max(peaks.angular_rps, state.angular_rps.norm());
  }
  return peaks;
}

}  // namespace

SmoothMotion::SmoothMotion(const MotionSettings& settings, const MotionPeaks& peaks)
    : workspace_(settings.workspace), start_rotation_(settings.start_rotation) {
  RandomNumbers random(settings.seed, 1);
  for (SmoothSignal& signal : position_) signal = SmoothSignal(random, 0.4);
  for (SmoothSignal& signal : angle_) signal = SmoothSignal(random, 0.28);
  MatchPeaks(peaks);
}

void SmoothMotion::MatchPeaks(const MotionPeaks& peaks) {
  if (peaks.linear_mps <= 0.0 && peaks.angular_rps <= 0.0) {
    position_speed_ = 0.0;
    angle_amplitude_rad_ = {0.0, 0.0, 0.0};
    return;
  }
  // Speed is not quite proportional to these, as the axes mix and the window moves: iterate.
  constexpr int kRounds = 8;
  for (int round = 0; round < kRounds; ++round) {
    const MotionPeaks reached = MeasurePeaks(*this);
    position_speed_ *= peaks.linear_mps / reached.linear_mps;
    for (double& amplitude : angle_amplitude_rad_) {
      amplitude *= peaks.angular_rps / reached.angular_rps;
    }
  }
  // To the amplitude of the position, speed is proportional; but the workspace is bounded.
  position_amplitude_ *= peaks.linear_mps / MeasurePeaks(*this).linear_mps;
  position_amplitude_ = std::min(position_amplitude_, 1.0);
}

RigidState<World, Object> SmoothMotion::At(double time_s) const {
  const double time = SoftStart::Time(time_s);
  const double rate = SoftStart::Rate(time_s);
  RigidState<World, Object> state;
  Vec3d position;
  for (int i = 0; i < 3; ++i) {
    const SmoothSignal& signal = position_[static_cast<std::size_t>(i)];
    const double half_m = position_amplitude_ * workspace_.half_extent_m[i];
    position[i] = workspace_.centre_m[i] + half_m * signal.Value(position_speed_ * time);
    state.linear_mps[i] = half_m * signal.Rate(position_speed_ * time) * position_speed_ * rate;
  }
  Mat3d rotation = Mat3d::Identity();
  for (std::size_t i = 0; i < kAxisOrder.size(); ++i) {
    const Vec3d axis = Vec3d::Unit(kAxisOrder[i]);
    const double turn = angle_[i].Value(time) - angle_[i].Value(0.0);
    state.angular_rps += rotation * axis * (angle_amplitude_rad_[i] * angle_[i].Rate(time) * rate);
    rotation = rotation * ExpSo3(Vec3d(axis * (angle_amplitude_rad_[i] * turn)));
  }
  state.pose = {Mat3d(rotation * start_rotation_), position};
  return state;
}

}  // namespace disflow::host
