// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/geometry/transform.h"

/// @file
/// The seam between what is compared with the model and the pose that is estimated from it.
///
/// A kind of residual is a class in a file of its own (surface_residual.h, edge_residual.h) with
/// - `int size() const`: how many observations there are in this frame,
/// - `Residual At(int i, const PoseObjectFromCamera& T_oc, float scale_m, Matching)`: observation
///   i under a pose, searched for within reach of a robust kernel of width scale_m, or matched with
///   what the last search found.
///
/// Gates, weights and sums are the same for all kinds: residual_sums.h. A further kind is one more
/// file, and one more line in Registration::Linearise().

namespace disflow {

/// What became of one observation in one step.
enum class ResidualStatus : std::uint8_t {
  kMatched,
  kUnmatched,       ///< Nothing of the model is near, or what is near tells no direction.
  kUnexpected,      ///< The same, of what need not be in the model.
  kNormalMismatch,  ///< Surface is near, but none whose normal agrees.
  kTruncated,       ///< Farther off than RegistrationConfig::truncation_m.
};

/// How far one observation is off the model under a pose, to first order in the observation's
/// position. Object frame.
struct Residual {
  ResidualStatus status = ResidualStatus::kUnmatched;  ///< The rest has a meaning if kMatched.
  Vec3 point_m = Vec3::Zero();                         ///< x^o = T_oc x^c, equation (2).
  Vec3 gradient = Vec3::Zero();                        ///< grad d
  /// |grad d|; 1 where `gradient` is of unit length by construction.
  float gradient_norm = 1.0F;
  float distance_m = 0.0F;   ///< d
  float variance_m2 = 0.0F;  ///< Of d: observation and model together.
  float per_radius = 0.0F;   ///< Derivative of d by the radius of the object's edges.
  float generation = 0.0F;   ///< Of the piece of surface, see Cluster.
  /// Squared angle between what the observation says of the gradient's direction and grad d: of a
  /// normal per component and less what its own noise explains, of an edge in the image [rad^2].
  float tilt_rad2 = 0.0F;
};

/// How observations find what they are matched with.
enum class Matching : std::uint8_t {
  kSearch,  ///< Anywhere near.
  kKeep,    ///< In the piece of surface of the last step, whose field is asked anew.
  kLinear,  ///< The same, by what its field was there, to first order.
};

}  // namespace disflow
