// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/flow/pose_uncertainty.h"
#include "disflow/types.h"

namespace disflow {

/// Root mean square distance of what was registered from the centre of rotation, weighted as the
/// registration weighted it; at least a millimetre.
[[nodiscard]] float LeverOf(const RegistrationInformation& information) noexcept;

/// How far off surface is built into the model, at the object.
struct PlacementScale {
  /// Pieces of surface that the model has grown by since the first view, each counted as often as
  /// its pose was noisier than its registration said; see Cluster::generation.
  float pieces = 0.0F;
  float outline_m = 0.0F;  ///< What all of an outline is off by.
  float lever_m = 0.0F;    ///< See LeverOf().
};

/// Variance of where one piece of surface is, at a point of it in any direction [m^2]: what all of
/// it shares with its outline and with the noise that was registered, and its turn.
[[nodiscard]] float PieceVariance(const Mat6& covariance, const PlacementScale& scale,
                                  const RegistrationConfig& config) noexcept;

/// Covariance of (position of the centre, rotation) that comes of where the model's surface is.
///
/// Surface that comes into view is built into the model with the error of its pose, and later poses
/// are registered to it. All of a face errs alike, so that the residuals do not show it: in its
/// place by about as much in all directions, however well they seem to tell some of them.
/// What the sensor's depth is off by from view to view is in all poses and in all surface.
/// @param covariance Of the registration alone.
[[nodiscard]] Mat6 DriftOf(const Mat6& covariance, const PlacementScale& scale,
                           const RegistrationConfig& config) noexcept;

}  // namespace disflow
