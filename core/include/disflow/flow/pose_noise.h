// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

#include "disflow/config.h"
#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// How noisy registered poses are from frame to frame, in multiples of what their covariances say:
/// the noise of neighbouring samples is alike, by how much depends on the sensor and on how many
/// pixels the object has, and no residual tells. The poses do: what a frame's pose deviates by from
/// that which leads through the three frames before is noise, but for what the motion has of jerk.
/// What scatters along the motion and not across it is the stamps' jitter.
class PoseNoise {
 public:
  /// What is known of the noise stays; the poses so far are none to go on from.
  void Restart() noexcept {
    known_ = 0;
    known_late_ = false;
  }

  /// Takes a registered pose.
  /// @param stamp_ns Later than the one before.
  /// @param center_m What the covariance is about, object frame.
  /// @param covariance Of (position of the centre, rotation) by the registration alone, object
  ///     axes, positive definite.
  /// @param motion What is expected of the object's jerk.
  void Learn(StampNs stamp_ns, const PoseCameraFromObject& T_co, const Vec3& center_m,
             const Mat6& covariance, const TwistFilterConfig& motion) noexcept;

  /// The poses' variance from frame to frame, of that of the registration.
  [[nodiscard]] float of_position() const noexcept { return of_position_; }
  [[nodiscard]] float of_rotation() const noexcept { return of_rotation_; }

  /// The variance of the stamps about the times at which the images were taken, s^2.
  [[nodiscard]] float of_stamps_s2() const noexcept { return std::max(stamp_variance_s2_, 0.0F); }

  /// The covariance of (position of the centre, rotation) as poses scatter.
  [[nodiscard]] Mat6 Of(const Mat6& covariance) const noexcept;

 private:
  struct Sight {
    StampNs stamp_ns = 0;
    PoseCameraFromObject T_co;
  };
  /// From the motion through the three poses before, (position of the centre, rotation) in camera
  /// axes.
  struct Deviation {
    Vec6 value;
    Vec6 per_second;  ///< What a stamp that is off by a second adds.
    float noises;     ///< How many times one pose's variance is in it.
    float dt_s;       ///< Mean step.
  };
  [[nodiscard]] Deviation DeviationOf(const Sight& sight, const Vec3& center_m) const noexcept;
  void LearnStamps(const Deviation& deviation, const Mat6& exact) noexcept;

  int known_ = 0;
  std::array<Sight, 3> before_;  ///< Oldest first; the last `known_` of them count.
  float of_position_ = 1.0F;
  float of_rotation_ = 1.0F;
  bool known_late_ = false;
  float late_s_ = 0.0F;             ///< What the last deviation along the motion takes.
  float stamp_variance_s2_ = 0.0F;  ///< Negative: surely none.
};

}  // namespace disflow
