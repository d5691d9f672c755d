// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_uncertainty.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "disflow/flow/pose_start.h"
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

/// Second moments of an angle.
struct TurnMoments {
  float angle2 = 0.0F;
  float angle_sine = 0.0F;
  float sine2 = 0.0F;
  float versine2 = 0.0F;  ///< Of 1 - cos.
};

/// Of an angle that is anything up to some bound, at most half a turn either way.
TurnMoments MomentsOf(float variance_rad2) noexcept {
  constexpr float kSmall_rad = 0.5F;  // where the closed forms would cancel
  const float a = std::min(std::sqrt(3.0F * variance_rad2), std::numbers::pi_v<float>);
  const float a2 = a * a;
  if (a < kSmall_rad) {
    // So far that E[angle^2] E[sine^2] is no less than E[angle sine]^2.
    return {a2 / 3.0F, a2 / 3.0F * (1.0F - a2 / 10.0F * (1.0F - a2 / 28.0F)),
            a2 / 3.0F * (1.0F - a2 / 5.0F * (1.0F - a2 * 2.0F / 21.0F)),
            a2 * a2 / 20.0F * (1.0F - a2 * 5.0F / 42.0F)};
  }
  const float mean_cos = std::sin(a) / a;
  const float mean_cos2 = std::sin(2.0F * a) / (2.0F * a);  // of twice the angle
  return {a2 / 3.0F, mean_cos - std::cos(a), 0.5F - 0.5F * mean_cos2,
          1.5F - 2.0F * mean_cos + 0.5F * mean_cos2};
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
  const Mat6 by_errors = across + information.of_edge_errors;
  Mat6 half;
  for (int i = 0; i < 6; ++i) half.col(i) = lower.solve(Vec6(by_errors.col(i)));
  Mat6 apparent;
  for (int i = 0; i < 6; ++i) apparent.col(i) = lower.solve(Vec6(half.row(i).transpose()));
  const SymmetricEigen6 directions(apparent);
  const Mat6 of_edges = information.total - information.surface;

  for (int i = 0; i < 6; ++i) {
    const Vec6 b = upper.solve(Vec6(directions.vectors.col(i)));
    // No more than what the surface tells can be apparent of it, and likewise of edges.
    const float told_by_edges = std::clamp(b.dot(of_edges * b), 0.0F, 1.0F);
    const float share = std::clamp(b.dot(across * b), 0.0F, 1.0F - told_by_edges) +
                        std::clamp(b.dot(information.of_edge_errors * b), 0.0F, told_by_edges);
    const bool observed = share < kAllApparent;
    const Mat6 told = b * b.transpose();
    result.covariance += (1.0F / (observed ? 1.0F - share : kRest)) * told;
    result.of_observed += (1.0F / (1.0F - std::min(share, kAllApparent))) * told;
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
  return unobserved_s < kLongest_s ? twist : WithoutTurn(twist, free_turn);
}

Twist WithoutTurn(const Twist& twist, const Mat6& free_turn) noexcept {
  constexpr float kLittle = 100.0F;  // of which a hundredth is left
  if (free_turn.isZero(0.0F)) return twist;
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

Mat6 OnItsArc(const Mat6& covariance) noexcept {
  const LongestAxis longest(covariance.bottomRightCorner<3, 3>());
  const Vec3& axis = longest.direction;
  const float variance_rad2 = longest.variance;
  if (!(variance_rad2 > 0.0F)) return covariance;
  const Vec6 with_angle = covariance.rightCols<3>() * axis;  // E[(displacement, theta) angle]
  const Mat6 beside = covariance - with_angle * with_angle.transpose() / variance_rad2;

  // Per radian: along the axis, a screw, it goes on for ever; across it, it goes round.
  const Vec3 tangent_m = with_angle.head<3>() / variance_rad2;
  Vec6 straight = with_angle / variance_rad2;
  straight.head<3>() = axis * axis.dot(tangent_m);
  Vec6 across = Vec6::Zero();
  across.head<3>() = tangent_m - straight.head<3>();
  Vec6 inward = Vec6::Zero();
  inward.head<3>() = axis.cross(tangent_m);
  const TurnMoments turn = MomentsOf(variance_rad2);
  return beside + turn.angle2 * straight * straight.transpose() +
         turn.angle_sine * (straight * across.transpose() + across * straight.transpose()) +
         turn.sine2 * across * across.transpose() + turn.versine2 * inward * inward.transpose();
}

}  // namespace disflow
