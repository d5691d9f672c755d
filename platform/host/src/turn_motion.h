// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/host/motion.h"

namespace disflow::host {

/// One full turn about a nearly vertical axis while the object wanders a little; the last tenth of
/// the sequence rests in the very pose of the start.
class TurnMotion final : public ObjectMotion {
 public:
  explicit TurnMotion(const MotionSettings& settings);
  [[nodiscard]] RigidState<World, Object> At(double time_s) const override;

 private:
  Workspace workspace_;
  Mat3d start_rotation_;
  double duration_s_;
  Vec3d axis_;
  Vec3d wander_m_;
};

}  // namespace disflow::host
