// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_start.h"

namespace disflow {

Vec3 CubeDirection(int index) noexcept {
  if (index < 6) {
    Vec3 axis = Vec3::Zero();
    axis[index / 2] = index % 2 == 0 ? 1.0F : -1.0F;
    return axis;
  }
  const int corner = index - 6;
  return Vec3(corner & 1 ? 1.0F : -1.0F, corner & 2 ? 1.0F : -1.0F, corner & 4 ? 1.0F : -1.0F)
      .normalized();
}

PoseObjectFromCamera HalfWay(const Vec3& center_c, const PoseObjectFromCamera& a,
                             const PoseObjectFromCamera& b) noexcept {
  const Vec3 turn = 0.5F * LogSo3(Mat3(b.rotation() * a.rotation().transpose()));
  const Mat3 rotation = ExpSo3(turn) * a.rotation();
  const Vec3 center_o = 0.5F * (a * center_c + b * center_c);
  return {rotation, Vec3(center_o - rotation * center_c)};
}

float ImpulsesApart(const Vec3& center_c, const PoseObjectFromCamera& T_oc,
                    const PoseObjectFromCamera& T_predicted) noexcept {
  constexpr float kShift_m = 0.025F;
  constexpr float kTurn_rad = 0.2F;
  const Vec3 shift = T_oc * center_c - T_predicted * center_c;
  const Vec3 turn = LogSo3(Mat3(T_oc.rotation() * T_predicted.rotation().transpose()));
  return shift.squaredNorm() / (kShift_m * kShift_m) + turn.squaredNorm() / (kTurn_rad * kTurn_rad);
}

}  // namespace disflow
