// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/motion_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "disflow/geometry/covariance.h"

namespace disflow {
namespace {

// Share by which a frame moves the jerk if its innovation lies along the one before: tenfold in 24
// frames. Half as much for the scatter.
constexpr float kGain = 0.1F;
// From an object at rest, whose poses shall not be taken for motion, to three times what is assumed
// of one in a swift hand: what is more uneven is hit, or has an end of its own.
constexpr float kLeastJerk = 1.0F / 30.0F;
constexpr float kMostJerk = 3.0F;
constexpr float kMostScatter = 30.0F;
// Of chi-squared with three degrees of freedom, per degree.
constexpr float kMedian = 0.789F;

}  // namespace

void MotionNoise::Restart() noexcept {
  for (Part& part : parts_) {
    part = {.jerk = std::max(part.jerk, 1.0F), .scatter = std::max(part.scatter, 1.0F)};
  }
}

void MotionNoise::Pause() noexcept {
  for (Part& part : parts_) part.before.setZero();
}

void MotionNoise::Learn(const Vec6& innovation, const Mat6& expected) noexcept {
  Follow(innovation.head<3>(), expected.topLeftCorner<3, 3>(), parts_[0]);
  Follow(innovation.tail<3>(), expected.bottomRightCorner<3, 3>(), parts_[1]);
}

/// Innovations of a filter that weighs motion and noise rightly have nothing to do with each other.
/// They agree where it follows too slowly, and alternate where it runs after the noise, whatever
/// their size. Their size, by its median, which hits leave alone, tells what both are off by alike.
void MotionNoise::Follow(const Vec3& innovation, const Mat3& expected, Part& part) noexcept {
  const Eigen::LLT<Mat3> cholesky(expected);
  const Vec3 white = cholesky.matrixL().solve(innovation);
  const float length = white.norm();
  const bool usable = cholesky.info() == Eigen::Success && std::isfinite(length) && length > 0.0F;
  const Vec3 direction = usable ? Vec3(white / length) : Vec3(Vec3::Zero());
  part.jerk *= 1.0F + kGain * direction.dot(part.before);
  part.jerk = std::clamp(part.jerk, kLeastJerk, kMostJerk);
  part.before = direction;
  if (!usable) return;
  const bool above = length * length > 3.0F * kMedian * part.scatter;
  part.scatter *= 1.0F + kGain * (above ? 0.5F : -0.5F);
  part.scatter = std::clamp(part.scatter, 1.0F / kMostScatter, kMostScatter);
}

Mat6 MotionNoise::Of(const Mat6& covariance) const noexcept {
  return ScaledCovariance(covariance, parts_[0].scatter, parts_[1].scatter);
}

}  // namespace disflow
