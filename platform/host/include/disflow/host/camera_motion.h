// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "disflow/host/rigid_state.h"
#include "disflow/host/smooth_signal.h"

namespace disflow::host {

/// A camera that is carried about while it looks at one place. Starts at the world's origin, at
/// rest.
class CameraMotion {
 public:
  /// @param target_distance_m Straight ahead at the start.
  CameraMotion(double target_distance_m, std::uint64_t seed);
  [[nodiscard]] RigidState<World, Camera> At(double time_s) const;

  /// A sphere must be thought larger by this to stay in view while the camera moves.
  static constexpr double kViewMargin_m = 0.025;

 private:
  double target_distance_m_;
  std::array<SmoothSignal, 4> signals_;  // x, y, z, roll
};

}  // namespace disflow::host
