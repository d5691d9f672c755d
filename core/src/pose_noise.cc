// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/pose_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "disflow/geometry/covariance.h"

namespace disflow {
namespace {

// Share of what is known by which a frame moves it.
constexpr float kShareGain = 0.1F;
// Of stamps that are taken for exact. Half a millisecond: at 0.5 m/s what poses scatter by before a
// D415.
constexpr float kNotable_s2 = 5e-4F * 5e-4F;
constexpr float kNone_s = std::numeric_limits<float>::quiet_NaN();

/// Moves a share towards the lower quartile of what deviations tell: things that are thrown, hit or
/// shaken for three frames of four leave it alone.
/// @param noise Covariance of the deviation where the share is 1.
/// @param others Covariance of what it has beside noise.
void Follow(const Vec3& deviation, const Mat3& noise, const Mat3& others, float& share) noexcept {
  constexpr float kQuartile = 0.25F;
  // Of chi-squared with three degrees of freedom, per degree.
  constexpr float kQuartileOfChiSquared = 0.404F;
  // An object at rest before a camera that repeats itself shows no noise at all.
  constexpr float kLeastShare = 0.05F;
  constexpr float kMostShare = 20.0F;
  const Eigen::LLT<Mat3> cholesky(Mat3(share * noise + others));
  const float observed = Vec3(cholesky.matrixL().solve(deviation)).squaredNorm() / 3.0F;
  if (cholesky.info() != Eigen::Success || !std::isfinite(observed)) return;
  const bool above = observed > kQuartileOfChiSquared;
  // A second at 30 Hz for twice the share, a third of a second for half of it.
  share *= 1.0F + kShareGain * (above ? kQuartile : kQuartile - 1.0F);
  share = std::clamp(share, kLeastShare, kMostShare);
}

/// From the motion through the three poses before, (position of the centre, rotation) in camera
/// axes.
struct Deviation {
  Vec6 value;
  Vec6 per_second;  ///< What a stamp that is off by a second adds.
  float noises;     ///< How many times one pose's variance is in it.
  float dt_s;       ///< Mean step.
};

/// @param before, sight Stamps and poses.
template <typename Sight>
Deviation DeviationFrom(const std::array<Sight, 3>& before, const Sight& sight,
                        const Vec3& center_m) noexcept {
  const auto since_s = [&](const Sight& earlier) {
    return Seconds(SpanNs(earlier.stamp_ns, sight.stamp_ns));
  };
  const float a = since_s(before[0]);
  const float b = since_s(before[1]);
  const float c = since_s(before[2]);
  // The parabola through three poses, continued to this stamp (Lagrange); with even steps 1, -3,
  // 3. Relative to the last of them.
  const float of_a = b * c / ((a - b) * (a - c));
  const float of_b = -a * c / ((a - b) * (b - c));
  const float of_c = 1.0F - of_a - of_b;
  const PoseCameraFromObject& last = before[2].T_co;
  const auto from_last = [&](const PoseCameraFromObject& T) {
    const Vec3 moved_m = T * center_m;
    const Vec3 from_m = last * center_m;
    Vec6 step;
    step.head<3>() = moved_m - from_m;
    step.tail<3>() = TurnBetween(last.rotation(), T.rotation());
    return step;
  };
  const Vec6 now = from_last(sight.T_co);
  const Vec6 first = from_last(before[0].T_co);
  return {.value = now - of_a * first - of_b * from_last(before[1].T_co),
          .per_second = (now - first) / a,
          .noises = 1.0F + of_a * of_a + of_b * of_b + of_c * of_c,
          .dt_s = a / 3.0F};
}

/// A stamp that is off makes the next deviations along the motion alternate; motion that bends
/// smoothly does not. Moves the variance of stamps towards what the median of their products tells.
/// @param exact Covariance of the deviation were stamps exact.
/// @param late_before_s What the deviation before took for the stamps that were in it; not finite:
///     there is none.
/// @param variance_s2 No variance as long as it is negative.
/// @return What this deviation takes for those that are in it.
float FollowStamps(const Deviation& deviation, const Mat6& exact, float late_before_s,
                   float& variance_s2) noexcept {
  // Of the negative product of two normal numbers whose correlation is -3/4.
  constexpr float kMedianProduct = 0.293F;
  // Poses that err along their motion by three times what is expected tell nothing of the stamps.
  constexpr float kDoubt = 9.0F;
  const Eigen::LLT<Mat6> cholesky(exact);
  if (cholesky.info() != Eigen::Success) return kNone_s;
  const Vec6 towards = cholesky.solve(deviation.per_second);
  const float information = deviation.per_second.dot(towards);
  const float late_s = towards.dot(deviation.value) / information;
  // Stamps that keep their order are off by no more than anywhere within a frame.
  const float dt = deviation.dt_s;
  const float most_s2 = dt * dt / 12.0F;
  // At rest nothing moves but the noise of the first and the last pose.
  const float of_rest = 12.0F / (9.0F * dt * dt * deviation.noises);
  const float signal = deviation.noises * most_s2 * std::max(information - of_rest, 0.0F);
  const float told = signal / (1.0F + signal);  // how much of what stamps may be off by is seen
  const float expected_s2 = kDoubt / information + deviation.noises * std::max(variance_s2, 0.0F);
  if (!std::isfinite(late_s * late_before_s + expected_s2 + told)) return late_s;
  const bool above = -late_s * late_before_s > kMedianProduct * expected_s2;
  variance_s2 += kShareGain * told * std::max(variance_s2, kNotable_s2) * (above ? 0.5F : -0.5F);
  variance_s2 = std::clamp(variance_s2, -kNotable_s2, most_s2);
  return late_s;
}

}  // namespace

void PoseNoise::Learn(StampNs stamp_ns, const PoseCameraFromObject& T_co, const Vec3& center_m,
                      const Mat6& covariance, const TwistFilterConfig& motion) noexcept {
  const Sight sight{stamp_ns, T_co};
  if (known_ == static_cast<int>(before_.size())) {
    const Deviation deviation = DeviationFrom(before_, sight, center_m);
    const Mat6 noise = deviation.noises * RotatedCovariance(covariance, T_co.rotation());
    // Third difference of the motion whose jerk is white: 11/20 of its density times dt^5.
    const float dt = deviation.dt_s;
    const float of_jerk = 0.55F * (dt * dt * dt) * (dt * dt);
    Vec6 of_motion;
    of_motion << Vec3::Constant(of_jerk * motion.linear_jerk_psd),
        Vec3::Constant(of_jerk * motion.angular_jerk_psd);
    const Vec6& u = deviation.per_second;
    Mat6 others = (deviation.noises * of_stamps_s2()) * (u * u.transpose());
    others.diagonal() += of_motion;
    Mat6 exact = Of(noise);
    exact.diagonal() += of_motion;
    late_s_ = FollowStamps(deviation, exact, late_s_, of_stamps_s2_);
    Follow(deviation.value.head<3>(), noise.topLeftCorner<3, 3>(), others.topLeftCorner<3, 3>(),
           of_position_);
    Follow(deviation.value.tail<3>(), noise.bottomRightCorner<3, 3>(),
           others.bottomRightCorner<3, 3>(), of_rotation_);
  } else {
    late_s_ = kNone_s;
  }
  std::rotate(before_.begin(), before_.begin() + 1, before_.end());
  before_.back() = sight;
  known_ = std::min(known_ + 1, static_cast<int>(before_.size()));
}

float PoseNoise::of_stamps_s2() const noexcept {
  return of_stamps_s2_ > kNotable_s2 ? of_stamps_s2_ : 0.0F;
}

Mat6 PoseNoise::Of(const Mat6& covariance) const noexcept {
  return ScaledCovariance(covariance, of_position_, of_rotation_);
}

}  // namespace disflow
