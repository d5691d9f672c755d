// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <numbers>

#include "disflow/host/motion.h"
#include "disflow/host/smooth_signal.h"

namespace disflow::host {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Highest speeds that a motion shall reach within its first ten seconds.
struct MotionPeaks {
  double linear_mps;
  double angular_rps;
};

/// Sums of sinusoids in position and in three angles, from rest.
class SmoothMotion final : public ObjectMotion {
 public:
  SmoothMotion(const MotionSettings& settings, const MotionPeaks& peaks);
  [[nodiscard]] RigidState<World, Object> At(double time_s) const override;

 private:
  /// Turns in the order of rotation: about the vertical, then sideways, then about the new forward.
  static constexpr std::array<int, 3> kAxisOrder{1, 0, 2};

  void MatchPeaks(const MotionPeaks& peaks);

  Workspace workspace_;
  Mat3d start_rotation_;
  std::array<SmoothSignal, 3> position_;
  std::array<SmoothSignal, 3> angle_;
  double position_speed_ = 1.0;      // time scale of the position
  double position_amplitude_ = 0.9;  // share of the workspace
  std::array<double, 3> angle_amplitude_rad_{1.0, 0.45, 0.45};
};

}  // namespace disflow::host
