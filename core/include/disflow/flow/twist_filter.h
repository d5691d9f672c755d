// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "disflow/config.h"
#include "disflow/estimate.h"
#include "disflow/flow/motion_noise.h"
#include "disflow/geometry/transform.h"

namespace disflow {

/// What a pose's covariance does not say of it.
struct PoseManner {
  float stamp_variance_s2 = 0.0F;  ///< How much its stamp varies about its time.
  bool complete = true;            ///< Whether it is told in all directions.
};

/// Kalman filter with constant acceleration, open to impulses, driven by registered poses; yields
/// velocity at the frame's capture time. A finite difference of poses would lag by half a frame.
/// Bar-Shalom et al., "Estimation with Applications to Tracking and Navigation", section 6.2.3
/// (white-noise jerk, whose density follows the object).
///
/// State in camera axes, six each: pose (the origin's position, rotation), twist, acceleration.
class TwistFilter {
 public:
  void Start(const TwistFilterConfig& config, StampNs stamp_ns, const PoseCameraFromObject& T_co,
             const Mat6& pose_covariance) noexcept;
  /// From now on.
  void Adjust(const TwistFilterConfig& config) noexcept { config_ = config; }

  /// Moves the state to a later stamp.
  void Predict(StampNs stamp_ns) noexcept;
  /// Corrects the state with a pose registered at the current stamp.
  void Update(const PoseCameraFromObject& T_co, const Mat6& pose_covariance,
              const PoseManner& manner = {}) noexcept;
  /// Lets the rate of a turn that no image tells fade over the last step, as a hand's does (Singer,
  /// 1970): registration takes noise for it, the next pose is expected by it, and so on.
  /// @param free_turn As PoseUncertainty::free_turn; of the object's origin, camera axes.
  void FadeTurn(const Mat6& free_turn, float time_constant_s) noexcept;
  /// Where the object would be at a stamp if it kept its velocity; does not change the state.
  [[nodiscard]] PoseCameraFromObject Extrapolate(StampNs stamp_ns) const noexcept;
  /// Takes another object frame on the same object for its own: motion stays what it was.
  /// @param T_co Pose of that frame at the current stamp.
  void MoveTo(const PoseCameraFromObject& T_co) noexcept;
  /// Forgets velocity and acceleration, as after a jump of the pose.
  void RestartMotion() noexcept;

  [[nodiscard]] const PoseCameraFromObject& T_co() const noexcept { return T_co_; }
  [[nodiscard]] Twist twist() const noexcept { return {twist_.head<3>(), twist_.tail<3>()}; }
  [[nodiscard]] const Mat6& pose_covariance() const noexcept { return covariance_[0][0]; }
  [[nodiscard]] Mat6 twist_covariance() const noexcept {
    return motion_noise_.Of(covariance_[1][1]);
  }
  /// With the jerk that this object is found to have.
  [[nodiscard]] TwistFilterConfig motion() const noexcept;
  [[nodiscard]] StampNs stamp_ns() const noexcept { return stamp_ns_; }

 private:
  static constexpr std::size_t kBlocks = 3;  // pose, twist, acceleration
  using Covariance = std::array<std::array<Mat6, kBlocks>, kBlocks>;

  void Turn(const Mat3& rotation) noexcept;
  void AddProcessNoise(float dt_s) noexcept;
  void AddImpulse() noexcept;
  void UpdateAlong(const Vec6& axis, float deviation,
                   std::array<Vec6, kBlocks>& correction) noexcept;

  TwistFilterConfig config_{};
  MotionNoise motion_noise_;
  StampNs stamp_ns_ = 0;
  float last_step_s_ = 0.0F;
  PoseCameraFromObject T_co_;
  Vec6 twist_ = Vec6::Zero();
  Vec6 acceleration_ = Vec6::Zero();
  Covariance covariance_;
};

}  // namespace disflow
