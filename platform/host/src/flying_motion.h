// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "disflow/host/motion.h"
#include "smooth_motion.h"

namespace disflow::host {

/// Straight flights with constant spin between velocity jumps, which come half-way between frames:
/// nothing that a tracker sees announces them.
class FlyingMotion final : public ObjectMotion {
 public:
  FlyingMotion(const MotionSettings& settings, const MotionPeaks& peaks);
  [[nodiscard]] RigidState<World, Object> At(double time_s) const override;

 private:
  struct Flight {
    double start_s;
    RigidState<World, Object> at_start;
  };
  std::vector<Flight> flights_;
};

}  // namespace disflow::host
