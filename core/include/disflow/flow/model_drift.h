// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/flow/pose_uncertainty.h"
#include "disflow/types.h"

namespace disflow {

/// How exactly a camera tells where surface belongs that comes into view.
struct PlacementScale {
  float pixel_m = 0.0F;        ///< Width of a pixel at the object's distance.
  float depth_noise_m = 0.0F;  ///< Of one pixel.
};

/// Root mean square distance of what was registered from the centre of rotation, weighted as the
/// registration weighted it; at least a millimetre.
[[nodiscard]] float LeverOf(const RegistrationInformation& information) noexcept;

/// Covariance of (position of the centre, rotation) with the drift of the model.
///
/// Surface that comes into view is built into the model with the error of its pose, and later poses
/// are registered to it. All of a face errs alike, so that the residuals do not show it. While a
/// face comes into view the pose hangs on outlines, which are off by a part of a pixel whatever
/// their number; which way the new face looks is told by its depth.
/// @param covariance Of the registration alone.
/// @param pieces Pieces of surface that the model has grown by since the first view.
/// @param lever_m See LeverOf().
[[nodiscard]] Mat6 WithDrift(const Mat6& covariance, float pieces, const PlacementScale& scale,
                             float lever_m, const RegistrationConfig& config) noexcept;

}  // namespace disflow
