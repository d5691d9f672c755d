// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/twist_filter.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "disflow/field/fast_math.h"
#include "disflow/flow/pose_uncertainty.h"
#include "disflow/geometry/covariance.h"
#include "disflow/geometry/symmetric_solver.h"

namespace disflow {
namespace {

// What is believed of an object's motion before it was seen to move.
constexpr float kInitialSpeedStd_mps = 0.5F;
constexpr float kInitialRateStd_rps = 3.0F;
constexpr float kInitialAccelerationStd_mps2 = 3.0F;
constexpr float kInitialAngularAccelerationStd_rps2 = 20.0F;
// A normalised innovation squared that smooth motion exceeds once in a million frames (chi-squared,
// six degrees of freedom), and what an impulse may do.
constexpr float kImpulseNis = 38.0F;
constexpr float kImpulseSpeedStd_mps = 0.4F;
constexpr float kImpulseRateStd_rps = 3.0F;
// An object that was just let go or hit keeps its new velocity.
constexpr float kImpulseAccelerationShare = 0.1F;
// Beyond this gap the extrapolation by velocity is worthless; the covariance says so anyway.
constexpr float kMaxStep_s = 2.0F;

Mat6 Diagonal(float linear, float angular) noexcept {
  Vec6 diagonal;
  diagonal << Vec3::Constant(linear), Vec3::Constant(angular);
  return diagonal.asDiagonal();
}

Mat6 InitialAcceleration() noexcept {
  return Diagonal(kInitialAccelerationStd_mps2 * kInitialAccelerationStd_mps2,
                  kInitialAngularAccelerationStd_rps2 * kInitialAngularAccelerationStd_rps2);
}

float StepSeconds(StampNs from_ns, StampNs to_ns) noexcept {
  return std::clamp(Seconds(SpanNs(from_ns, to_ns)), 0.0F, kMaxStep_s);
}

PoseCameraFromObject Displaced(const PoseCameraFromObject& T_co,
                               const Vec6& displacement) noexcept {
  // Position and rotation are moved apart: the twist is that of the object's origin, not of the
  // camera's.
  const Vec3 rotation_vector = displacement.tail<3>();
  return PoseCameraFromObject(Mat3(ExpSo3(rotation_vector) * T_co.rotation()),
                              Vec3(T_co.translation() + displacement.head<3>()))
      .Normalized();
}

}  // namespace

void TwistFilter::RestartMotion() noexcept {
  motion_noise_.Restart();
  twist_.setZero();
  acceleration_.setZero();
  for (std::size_t i = 0; i < kBlocks; ++i) {
    for (std::size_t j = 0; j < kBlocks; ++j) {
      if (i != 0 || j != 0) covariance_[i][j].setZero();
    }
  }
  covariance_[1][1] = Diagonal(kInitialSpeedStd_mps * kInitialSpeedStd_mps,
                               kInitialRateStd_rps * kInitialRateStd_rps);
  covariance_[2][2] = InitialAcceleration();
}

void TwistFilter::Start(const TwistFilterConfig& config, StampNs stamp_ns,
                        const PoseCameraFromObject& T_co, const Mat6& pose_covariance) noexcept {
  config_ = config;
  motion_noise_ = {};
  stamp_ns_ = stamp_ns;
  T_co_ = T_co;
  covariance_[0][0] = pose_covariance;
  RestartMotion();
}

void TwistFilter::MoveTo(const PoseCameraFromObject& T_co) noexcept {
  const Vec3 shift_m = T_co.translation() - T_co_.translation();
  const Vec3 rate_rps = twist_.tail<3>();
  twist_.head<3>() += rate_rps.cross(shift_m);
  T_co_ = T_co;
}

PoseCameraFromObject TwistFilter::Extrapolate(StampNs stamp_ns) const noexcept {
  return Displaced(T_co_, StepSeconds(stamp_ns_, stamp_ns) * twist_);
}

void TwistFilter::Predict(StampNs stamp_ns) noexcept {
  const float dt = StepSeconds(stamp_ns_, stamp_ns);
  const float half_dt2 = 0.5F * dt * dt;
  last_step_s_ = dt;
  Turn(ExpSo3(Vec3(dt * twist_.tail<3>())));
  T_co_ = Displaced(T_co_, dt * twist_ + half_dt2 * acceleration_);
  twist_ += dt * acceleration_;
  stamp_ns_ = stamp_ns;

  // P <- F P F^T with F = [I, dt, dt^2/2; 0, I, dt; 0, 0, I] (times the 6x6 identity each): rows,
  // then columns.
  Covariance& p = covariance_;
  for (std::size_t j = 0; j < kBlocks; ++j) {
    p[0][j] += dt * p[1][j] + half_dt2 * p[2][j];
    p[1][j] += dt * p[2][j];
  }
  for (std::size_t i = 0; i < kBlocks; ++i) {
    p[i][0] += dt * p[i][1] + half_dt2 * p[i][2];
    p[i][1] += dt * p[i][2];
  }
  AddProcessNoise(dt);
}

/// What is not known of a pose moves with the object: the axis of a can stays the can's.
void TwistFilter::Turn(const Mat3& rotation) noexcept {
  for (auto& row : covariance_) {
    for (Mat6& block : row) block = RotatedCovariance(block, rotation);
  }
}

/// The object was hit or let go since the last frame, at an unknown time: its velocity may have
/// jumped, and what was known of its acceleration is void.
void TwistFilter::AddImpulse() noexcept {
  motion_noise_.Restart();
  const Mat6 jump = Diagonal(kImpulseSpeedStd_mps * kImpulseSpeedStd_mps,
                             kImpulseRateStd_rps * kImpulseRateStd_rps);
  const float dt = last_step_s_;
  covariance_[0][0] += (dt * dt / 3.0F) * jump;
  covariance_[0][1] += (0.5F * dt) * jump;
  covariance_[1][0] += (0.5F * dt) * jump;
  covariance_[1][1] += jump;
  for (std::size_t i = 0; i < kBlocks; ++i) covariance_[2][i] = covariance_[i][2] = Mat6::Zero();
  covariance_[2][2] = kImpulseAccelerationShare * InitialAcceleration();
  acceleration_.setZero();
}

TwistFilterConfig TwistFilter::motion() const noexcept {
  TwistFilterConfig motion = config_;
  motion.linear_jerk_psd *= motion_noise_.of_position();
  motion.angular_jerk_psd *= motion_noise_.of_rotation();
  return motion;
}

void TwistFilter::AddProcessNoise(float dt) noexcept {
  const TwistFilterConfig expected = motion();
  const Mat6 jerk_psd = Diagonal(expected.linear_jerk_psd, expected.angular_jerk_psd);
  const float dt2 = dt * dt;
  const float dt3 = dt2 * dt;
  const float q[kBlocks][kBlocks] = {{dt3 * dt2 / 20.0F, dt2 * dt2 / 8.0F, dt3 / 6.0F},
                                     {dt2 * dt2 / 8.0F, dt3 / 3.0F, dt2 / 2.0F},
                                     {dt3 / 6.0F, dt2 / 2.0F, dt}};
  for (std::size_t i = 0; i < kBlocks; ++i) {
    for (std::size_t j = 0; j < kBlocks; ++j) covariance_[i][j] += q[i][j] * jerk_psd;
  }
}

void TwistFilter::Update(const PoseCameraFromObject& T_co, const Mat6& pose_covariance,
                         const PoseManner& manner) noexcept {
  Vec6 innovation;
  innovation.head<3>() = T_co.translation() - T_co_.translation();
  innovation.tail<3>() = TurnBetween(T_co_.rotation(), T_co.rotation());
  // A stamp that is off leaves the pose where the object was, or is going to be, at its twist.
  const Mat6 of_stamp =
      manner.stamp_variance_s2 * (twist_ * twist_.transpose() + covariance_[1][1]);
  const Mat6 noise = Resolvable(pose_covariance + of_stamp, covariance_[0][0].diagonal());
  const Eigen::LLT<Mat6> cholesky(noise);
  const SymmetricSolver6 solver(covariance_[0][0] + noise);
  // Only for a measurement that is not finite; the prediction stands.
  if (cholesky.info() != Eigen::Success || !solver.ok() || !innovation.allFinite()) return;
  if (innovation.dot(solver.Solve(innovation)) > kImpulseNis) {
    AddImpulse();
  } else if (!manner.complete || manner.stamp_variance_s2 > 0.0F) {
    motion_noise_.Pause();
  } else {
    motion_noise_.Learn(innovation, covariance_[0][0] + noise);
  }

  // Along independent axes, one after the other: a matrix of all of them at once, of which some are
  // known a million times better than others, has no inverse in float.
  const Mat6 factor = cholesky.matrixL();
  std::array<Vec6, kBlocks> correction{Vec6::Zero(), Vec6::Zero(), Vec6::Zero()};
  for (int k = 0; k < 6; ++k) {
    // Row k of L^-1: its measurement has the variance 1.
    const Vec6 axis = factor.triangularView<Eigen::Lower>().transpose().solve(Vec6(Vec6::Unit(k)));
    UpdateAlong(axis, axis.dot(innovation - correction[0]), correction);
  }
  T_co_ = Displaced(T_co_, correction[0]);
  twist_ += correction[1];
  acceleration_ += correction[2];
}

void TwistFilter::FadeTurn(const Mat6& free_turn, float time_constant_s) noexcept {
  const float kept = FastExpNonPositive(-last_step_s_ / time_constant_s);
  const auto without_turn = [&free_turn](const Vec6& motion) {
    const Twist known = WithoutTurn({motion.head<3>(), motion.tail<3>()}, free_turn);
    Vec6 result;
    result << known.linear_mps, known.angular_rps;
    return result;
  };
  twist_ = kept * twist_ + (1.0F - kept) * without_turn(twist_);
  acceleration_ = without_turn(acceleration_);
}

/// Takes one number into account, axis . pose, measured with the variance 1.
/// @param deviation What it differs by from what is expected by now.
void TwistFilter::UpdateAlong(const Vec6& axis, float deviation,
                              std::array<Vec6, kBlocks>& correction) noexcept {
  std::array<Vec6, kBlocks> cross;
  for (std::size_t i = 0; i < kBlocks; ++i) cross[i] = covariance_[i][0] * axis;
  const float variance = 1.0F + std::max(axis.dot(cross[0]), 0.0F);
  for (std::size_t i = 0; i < kBlocks; ++i) {
    const Vec6 gain = cross[i] / variance;
    correction[i] += deviation * gain;
    for (std::size_t j = i; j < kBlocks; ++j)
      covariance_[i][j].noalias() -= gain * cross[j].transpose();
  }
  // Rounding must not make the covariance asymmetric.
  for (std::size_t i = 0; i < kBlocks; ++i) {
    covariance_[i][i] = 0.5F * (covariance_[i][i] + covariance_[i][i].transpose().eval());
    for (std::size_t j = 0; j < i; ++j) covariance_[i][j] = covariance_[j][i].transpose();
  }
}

}  // namespace disflow
