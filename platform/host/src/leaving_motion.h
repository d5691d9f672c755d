// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/host/motion.h"

namespace disflow::host {

/// Leaves the view to the right, stays out for a while and comes back, turning slowly all the time.
class LeavingMotion final : public ObjectMotion {
 public:
  explicit LeavingMotion(const MotionSettings& settings);
  [[nodiscard]] RigidState<World, Object> At(double time_s) const override;

 private:
  Vec3d start_m_;
  Mat3d start_rotation_;
};

}  // namespace disflow::host
