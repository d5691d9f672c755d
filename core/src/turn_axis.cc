// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/turn_axis.h"

#include <cmath>

#include "disflow/flow/pose_start.h"
#include "disflow/flow/registration_result.h"

namespace disflow {

TurnAxis AxisOf(const Mat6& free_turn) noexcept {
  const Mat3 axes = PrincipalAxes(Mat3(free_turn.bottomRightCorner<3, 3>()));
  Vec6 largest = Vec6::Zero();
  for (int i = 0; i < 3; ++i) {
    const Vec6 turn = free_turn.rightCols<3>() * axes.col(i);
    if (turn.tail<3>().squaredNorm() > largest.tail<3>().squaredNorm()) largest = turn;
  }
  // The origin's velocity is rate x (origin - point).
  const Vec3 rate = largest.tail<3>();
  const float squared = rate.squaredNorm();
  if (!(squared > 0.0F)) return {};
  return {rate / std::sqrt(squared), rate.cross(Vec3(largest.head<3>())) / squared};
}

PoseObjectFromCamera TurnedAbout(const TurnAxis& axis, float angle_rad,
                                 const PoseObjectFromCamera& T_oc) noexcept {
  Vec6 turn = Vec6::Zero();
  turn.tail<3>() = angle_rad * axis.direction;
  return StepAbout(axis.point_m, turn, T_oc);
}

}  // namespace disflow
