// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "disflow/config.h"
#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// How noisy poses are from frame to frame, in multiples of what registrations say: neighbouring
/// samples err alike, and no residual tells. What a pose deviates by from the three before is
/// noise, but for the motion's jerk; what alternates along the motion alone is of stamps that are
/// off.
class PoseNoise {
 public:
  /// What is known of the noise stays; the poses so far are none to go on from.
  void Restart() noexcept { known_ = 0; }

  /// Takes a registered pose.
  /// @param stamp_ns Later than the one before.
  /// @param center_m What the covariance is about, object frame.
  /// @param covariance Of (centre's position, rotation) by the registration alone, object axes.
  /// @param motion What is expected of the object's jerk.
  void Learn(StampNs stamp_ns, const PoseCameraFromObject& T_co, const Vec3& center_m,
             const Mat6& covariance, const TwistFilterConfig& motion) noexcept;

  /// The poses' variance from frame to frame, of that of the registration; that of the stamps.
  [[nodiscard]] float of_position() const noexcept { return of_position_; }
  [[nodiscard]] float of_rotation() const noexcept { return of_rotation_; }
  [[nodiscard]] float of_stamps_s2() const noexcept;

  /// The covariance of (position of the centre, rotation) as poses scatter.
  [[nodiscard]] Mat6 Of(const Mat6& covariance) const noexcept;

 private:
  struct Sight {
    StampNs stamp_ns = 0;
    PoseCameraFromObject T_co;
  };

  int known_ = 0;
  std::array<Sight, 3> before_;  ///< Oldest first; the last `known_` of them count.
  float of_position_ = 1.0F;
  float of_rotation_ = 1.0F;
  float of_stamps_s2_ = 0.0F;  ///< Negative: the less likely.
  float late_s_ = 0.0F;        ///< By how much the last pose was, with the stamps before.
};

}  // namespace disflow
