// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_start.h"

#include <cmath>

#include "disflow/geometry/symmetric_eigen.h"

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

Mat3 PrincipalAxes(const Mat3& covariance) noexcept {
  Mat6 padded = Mat6::Zero();
  padded.topLeftCorner<3, 3>() = covariance;
  return SymmetricEigen6(padded).vectors.topLeftCorner<3, 3>();
}

LongestAxis::LongestAxis(const Mat3& covariance) noexcept {
  const Mat3 axes = PrincipalAxes(covariance);
  int longest = 0;
  variance = Vec3((axes.transpose() * covariance * axes).diagonal()).maxCoeff(&longest);
  direction = axes.col(longest);
}

PoseObjectFromCamera TurnedOver(const PoseObjectFromCamera& T_oc, const Vec3& axis,
                                const Vec3& center_m) noexcept {
  const Mat3 half_turn = 2.0F * axis * axis.transpose() - Mat3::Identity();
  return {Mat3(half_turn * T_oc.rotation()),
          Vec3(half_turn * (T_oc.translation() - center_m) + center_m)};
}

PoseObjectFromCamera HalfWay(const Vec3& center_c, const PoseObjectFromCamera& a,
                             const PoseObjectFromCamera& b) noexcept {
  const Vec3 turn = 0.5F * TurnBetween(a.rotation(), b.rotation());
  const Mat3 rotation = ExpSo3(turn) * a.rotation();
  const Vec3 center_o = 0.5F * (a * center_c + b * center_c);
  return {rotation, Vec3(center_o - rotation * center_c)};
}

ImpulsesApart::ImpulsesApart(const Vec3& center_c, const PoseObjectFromCamera& T_oc,
                             const PoseObjectFromCamera& T_predicted) noexcept {
  constexpr float kShift_m = 0.025F;
  constexpr float kTurn_rad = 0.2F;
  const Vec3 shift = T_oc * center_c - T_predicted * center_c;
  const Vec3 turn = TurnBetween(T_predicted.rotation(), T_oc.rotation());
  shift2 = shift.squaredNorm() / (kShift_m * kShift_m);
  turn2 = turn.squaredNorm() / (kTurn_rad * kTurn_rad);
}

}  // namespace disflow
