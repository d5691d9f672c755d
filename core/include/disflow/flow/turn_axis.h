// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// A line in the object frame.
struct TurnAxis {
  Vec3 direction = Vec3::UnitZ();  ///< Unit.
  Vec3 point_m = Vec3::Zero();     ///< On it, the nearest to the origin.
};

/// The axis of the largest of some turns.
/// @param free_turn As FreeAxis::Learn() takes it; not zero.
[[nodiscard]] TurnAxis AxisOf(const Mat6& free_turn) noexcept;

/// The pose of an object that has been turned about an axis of its own.
[[nodiscard]] PoseObjectFromCamera TurnedAbout(const TurnAxis& axis, float angle_rad,
                                               const PoseObjectFromCamera& T_oc) noexcept;

}  // namespace disflow
