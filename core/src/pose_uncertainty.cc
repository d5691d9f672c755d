// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_uncertainty.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "disflow/geometry/symmetric_eigen.h"

namespace disflow {
namespace {

// How far an object may move in a second, where nothing is known of it.
constexpr float kAnySpeed_mps = 0.5F;
constexpr float kAnyRate_rps = 3.0F;
// Share of the information that gradient errors explain from which on nothing is observed.
constexpr float kAllApparent = 0.5F;
// Share of a motion that is a turn from which on it is one.
constexpr float kMostlyTurn = 0.9F;
// Information that is left then, as a share: the covariance must stay within what float holds.
constexpr float kRest = 1e-3F;
// Relative information that every direction has, so that a plane has an inverse.
constexpr float kFloor = 1e-5F;

Mat6 WithFloor(const Mat6& information) noexcept {
  Mat6 h = information;
  const float position = h.diagonal().head<3>().mean();
  const float rotation = h.diagonal().tail<3>().mean();
  h.diagonal().head<3>().array() += kFloor * position;
  h.diagonal().tail<3>().array() += kFloor * rotation;
  return h;
}

/// Length of a direction in units of the distance that an object may move in a second.
float Duration_s(const Vec6& direction) noexcept {
  return std::sqrt(direction.head<3>().squaredNorm() / (kAnySpeed_mps * kAnySpeed_mps) +
                   direction.tail<3>().squaredNorm() / (kAnyRate_rps * kAnyRate_rps));
}

}  // namespace

PoseUncertainty FindPoseUncertainty(const RegistrationInformation& information,
                                    float least_gradient_std) noexcept {
  PoseUncertainty result;
  const Eigen::LLT<Mat6> cholesky(WithFloor(information.total));
  if (cholesky.info() != Eigen::Success || !information.total.allFinite()) return result;
  const Mat6 l = cholesky.matrixL();
  const auto lower = l.triangularView<Eigen::Lower>();
  const auto upper = l.transpose().triangularView<Eigen::Upper>();

  // In coordinates in which H is the identity. One column at a time: Eigen's solve for several
  // refers to malloc.
  const float gradient_variance_rad2 =
      least_gradient_std * least_gradient_std + information.gradient_variance_rad2;
  const Mat6 across = gradient_variance_rad2 * information.across;
  Mat6 half;
  for (int i = 0; i < 6; ++i) half.col(i) = lower.solve(Vec6(across.col(i)));
  Mat6 apparent;
  for (int i = 0; i < 6; ++i) apparent.col(i) = lower.solve(Vec6(half.row(i).transpose()));
  const SymmetricEigen6 directions(apparent);
  const Mat6 of_edges = information.total - information.surface;

  for (int i = 0; i < 6; ++i) {
    const Vec6 b = upper.solve(Vec6(directions.vectors.col(i)));
    // No more than what the surface tells can be apparent.
    const float of_surface = 1.0F - b.dot(of_edges * b);
    const float share = std::clamp(directions.values[i], 0.0F, std::max(of_surface, 0.0F));
    const bool observed = share < kAllApparent;
    result.covariance += (1.0F / (observed ? 1.0F - share : kRest)) * b * b.transpose();
    if (observed) continue;
    const Vec6 u = b / Duration_s(b);
    result.unobserved += u * u.transpose();
    const float turn = u.tail<3>().squaredNorm() / (kAnyRate_rps * kAnyRate_rps);
    if (turn > kMostlyTurn) result.free_turn += u * u.transpose();
  }
  result.solved = result.covariance.allFinite();
  return result;
}

Twist KnownTwist(const Twist& twist, const Mat6& free_turn, float unobserved_s) noexcept {
  // Of bottles the turn about their axis is often not told for a second, and still known.
  constexpr float kLongest_s = 1.5F;
  constexpr float kLittle = 100.0F;  // of which a hundredth is left
  if (free_turn.isZero(0.0F) || unobserved_s < kLongest_s) return twist;
  Vec6 per_unit = Vec6::Constant(1.0F / kAnyRate_rps);
  per_unit.head<3>().setConstant(1.0F / kAnySpeed_mps);
  Vec6 rate;
  rate.head<3>() = twist.linear_mps;
  rate.tail<3>() = twist.angular_rps;
  const Eigen::LLT<Mat6> held(Mat6::Identity() +
                              kLittle * per_unit.asDiagonal() * free_turn * per_unit.asDiagonal());
  const Vec6 known = held.solve(Vec6(rate.cwiseProduct(per_unit))).cwiseQuotient(per_unit);
  if (held.info() != Eigen::Success || !known.allFinite()) return twist;
  return {known.head<3>(), known.tail<3>()};
}

float RememberGradientVariance(float before_rad2, float by_frame_rad2) noexcept {
  // As long as a sample of the model takes to average its noise away (field.freeze_after).
  constexpr float kFrames = 15.0F;
  // Written so that NaN changes nothing.
  if (!(by_frame_rad2 >= 0.0F)) return before_rad2;
  return std::max(by_frame_rad2, before_rad2 + (by_frame_rad2 - before_rad2) / kFrames);
}

Mat3 OffTangent(const Mat6& covariance) noexcept {
  constexpr float kTiny = 1e-12F;
  const Mat3 displacement = covariance.topLeftCorner<3, 3>();
  const Mat3 cross = covariance.topRightCorner<3, 3>();  // E[displacement theta^T]
  const Vec3 inward_m =
      0.5F * Vec3(cross(2, 1) - cross(1, 2), cross(0, 2) - cross(2, 0), cross(1, 0) - cross(0, 1));
  const float theta2 = covariance.diagonal().tail<3>().sum();
  const float radius2_m2 = displacement.trace() / std::max(theta2, kTiny);
  const float inward2_m2 = inward_m.squaredNorm();
  const float share = std::min(1.0F, radius2_m2 / std::max(inward2_m2, kTiny));
  return share * (inward_m * inward_m.transpose() +
                  (inward2_m2 / std::max(displacement.trace(), kTiny)) * displacement);
}

}  // namespace disflow
