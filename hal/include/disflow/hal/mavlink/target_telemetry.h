// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/estimate.h"
#include "disflow/geometry/transform.h"
#include "disflow/hal/camera_pose_history.h"
#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/messages.h"
#include "disflow/hal/mavlink/telemetry.h"

/// @file
/// The tracked object as autopilots want it to land on or to follow: docs/wire-format.md. Neither
/// message can say that a pose is only predicted, so both are made of measured ones alone.

namespace disflow::hal::mavlink {

/// @param T_bc Where the optical frame sits in the vehicle, whose axes are forward, right, down.
/// @param world Axes of the estimate's world.
/// @param target_num Of several.
/// @return Position and attitude in the world if that is north-east-down and the estimate has it,
/// else in the vehicle (MAV_FRAME_BODY_FRD); kNotInitialised: nothing was measured.
[[nodiscard]] Expected<LandingTarget> MakeLandingTarget(const Estimate& estimate,
                                                        const Transform<Body, Camera>& T_bc,
                                                        MavFrame world,
                                                        std::uint8_t target_num) noexcept;

/// Learns where on Earth the vehicle's local frame has its origin.
class EarthOrigin {
 public:
  /// @param system_id The vehicle's.
  explicit EarthOrigin(std::uint8_t system_id) noexcept : system_id_(system_id) {}

  /// Other messages, those of other systems and places that are none are passed over.
  void Take(const FrameView& frame) noexcept;
  [[nodiscard]] bool known() const noexcept { return known_; }
  [[nodiscard]] const GpsGlobalOrigin& origin() const noexcept { return origin_; }

 private:
  std::uint8_t system_id_;
  bool known_ = false;
  GpsGlobalOrigin origin_;
};

/// @param world Axes of the estimate's world: kLocalNed or kLocalEnu.
/// @return kNotInitialised: nothing was measured, the camera's pose or the origin is not known;
/// kInvalidTransform: 100 km and more from the origin.
[[nodiscard]] Expected<FollowTarget> MakeFollowTarget(const Estimate& estimate, MavFrame world,
                                                      const EarthOrigin& earth) noexcept;

}  // namespace disflow::hal::mavlink
