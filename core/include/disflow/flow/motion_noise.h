// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "disflow/geometry/transform.h"

namespace disflow {

/// How unevenly an object moves, by what a filter's predictions miss; position and rotation apart.
/// Mehra, "On the identification of variances and adaptive Kalman filtering", 1970.
class MotionNoise {
 public:
  /// It was hit, or let go: its motion is at least as uneven as was assumed, as far as is known.
  void Restart() noexcept;
  /// A frame that tells nothing: its pose is not told in all directions, so that noise is followed,
  /// or its stamp is off, which shows in the next step too.
  void Pause() noexcept;
  /// @param innovation, expected Deviation of a measurement from its prediction, its covariance.
  void Learn(const Vec6& innovation, const Mat6& expected) noexcept;

  /// Density of the jerk, of position and of rotation, in multiples of what was assumed.
  [[nodiscard]] float of_position() const noexcept { return parts_[0].jerk; }
  [[nodiscard]] float of_rotation() const noexcept { return parts_[1].jerk; }
  /// A covariance that follows from noise and jerk, as predictions turn out to be off.
  [[nodiscard]] Mat6 Of(const Mat6& covariance) const noexcept;

 private:
  struct Part {
    float jerk = 1.0F;
    float scatter = 1.0F;        ///< Variance of innovations, of what is expected.
    Vec3 before = Vec3::Zero();  ///< The last innovation's direction where noise is white, or 0.
  };
  static void Follow(const Vec3& innovation, const Mat3& expected, Part& part) noexcept;

  std::array<Part, 2> parts_;
};

}  // namespace disflow
