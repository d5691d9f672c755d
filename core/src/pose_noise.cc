// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "disflow/geometry/covariance.h"

namespace disflow {
namespace {

/// Moves a share towards the lower quartile of what deviations tell: things that are thrown, hit or
/// shaken for three frames of four leave it alone.
/// @param noise Covariance of the deviation where the share is 1.
/// @param of_motion Variance of its components that is no noise.
void Follow(const Vec3& deviation, const Mat3& noise, float of_motion, float& share) noexcept {
  constexpr float kQuartile = 0.25F;
  // Of chi-squared with three degrees of freedom, per degree.
  constexpr float kQuartileOfChiSquared = 0.404F;
  // A second at 30 Hz for twice the share, a third of a second for half of it.
  constexpr float kGain = 0.1F;
  // An object at rest before a camera that repeats itself shows no noise at all.
  constexpr float kLeastShare = 0.05F;
  constexpr float kMostShare = 20.0F;
  const Eigen::LLT<Mat3> cholesky(Mat3(share * noise + of_motion * Mat3::Identity()));
  const float observed = Vec3(cholesky.matrixL().solve(deviation)).squaredNorm() / 3.0F;
  if (cholesky.info() != Eigen::Success || !std::isfinite(observed)) return;
  const bool above = observed > kQuartileOfChiSquared;
  share *= 1.0F + kGain * (above ? kQuartile : kQuartile - 1.0F);
  share = std::clamp(share, kLeastShare, kMostShare);
}

}  // namespace

void PoseNoise::Learn(StampNs stamp_ns, const PoseCameraFromObject& T_co, const Vec3& center_m,
                      const Mat6& covariance, const TwistFilterConfig& motion) noexcept {
  if (known_ == static_cast<int>(before_.size())) {
    const auto since_s = [&](const Sight& sight) {
      return Seconds(SpanNs(sight.stamp_ns, stamp_ns));
    };
    const float a = since_s(before_[0]);
    const float b = since_s(before_[1]);
    const float c = since_s(before_[2]);
    // The parabola through three poses, continued to this stamp (Lagrange); with even steps 1, -3,
    // 3. Relative to the last of them.
    const float of_a = b * c / ((a - b) * (a - c));
    const float of_b = -a * c / ((a - b) * (b - c));
    const float of_c = 1.0F - of_a - of_b;
    const float noises = 1.0F + of_a * of_a + of_b * of_b + of_c * of_c;
    const PoseCameraFromObject& last = before_[2].T_co;
    const auto from_last = [&](const PoseCameraFromObject& T) {
      const Vec3 moved_m = T * center_m;
      const Vec3 from_m = last * center_m;
      Vec6 step;
      step.head<3>() = moved_m - from_m;
      step.tail<3>() = TurnBetween(last.rotation(), T.rotation());
      return step;
    };
    const Vec6 deviation =
        from_last(T_co) - of_a * from_last(before_[0].T_co) - of_b * from_last(before_[1].T_co);
    // Third difference of the motion whose jerk is white: 11/20 of its density times dt^5.
    const float dt = a / 3.0F;
    const float of_jerk = 0.55F * (dt * dt * dt) * (dt * dt);
    const Mat6 noise = noises * RotatedCovariance(covariance, T_co.rotation());
    Follow(deviation.head<3>(), noise.topLeftCorner<3, 3>(), of_jerk * motion.linear_jerk_psd,
           of_position_);
    Follow(deviation.tail<3>(), noise.bottomRightCorner<3, 3>(), of_jerk * motion.angular_jerk_psd,
           of_rotation_);
  }
  std::rotate(before_.begin(), before_.begin() + 1, before_.end());
  before_.back() = {stamp_ns, T_co};
  known_ = std::min(known_ + 1, static_cast<int>(before_.size()));
}

Mat6 PoseNoise::Of(const Mat6& covariance) const noexcept {
  Vec6 scale;
  scale << Vec3::Constant(std::sqrt(of_position_)), Vec3::Constant(std::sqrt(of_rotation_));
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

}  // namespace disflow
