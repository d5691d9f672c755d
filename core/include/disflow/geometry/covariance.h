// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/types.h"

/// @file
/// Changes of axes and of reference point for covariances of two vectors: (position, rotation
/// vector) of a pose, (linear, angular) of a twist.

namespace disflow {

/// The covariance in other axes: diag(R, R) C diag(R, R)^T.
/// @param rotation R, from the covariance's axes to the wanted ones.
[[nodiscard]] Mat6 RotatedCovariance(const Mat6& covariance, const Mat3& rotation) noexcept;

/// The covariance of a vector whose first half has its variances multiplied by one factor, and its
/// second by another; correlations stay.
[[nodiscard]] Mat6 ScaledCovariance(const Mat6& covariance, float first, float second) noexcept;

/// The covariance of (position, rotation vector) at another point of the same rigid body, in other
/// axes. The lever makes position of rotation: dx' = R (dx + dtheta x to_point).
/// @param rotation R, from the covariance's axes to the wanted ones.
/// @param to_point_m From the covariance's point to the wanted one, in the covariance's axes.
[[nodiscard]] Mat6 CovarianceAtPoint(const Mat6& covariance, const Mat3& rotation,
                                     const Vec3& to_point_m) noexcept;

/// Covariance of the velocity that a point of a turning body is taken for to have because its place
/// is uncertain: that of rate x displacement.
/// @param place_m2 Covariance of the displacement.
/// @param rate2_rps2 Mean of rate rate^T.
[[nodiscard]] Mat3 VelocityCovarianceOfPlace(const Mat3& place_m2, const Mat3& rate2_rps2) noexcept;

/// Standard deviations along the axis along which they are largest.
[[nodiscard]] float LargestPositionStd(const Mat6& covariance) noexcept;
[[nodiscard]] float LargestRotationStd(const Mat6& covariance) noexcept;

/// The covariance as far as float can tell it: variances a million times smaller than the largest
/// are lost in its rounding, which could make the matrix indefinite. They are raised to that.
/// @param beside Variances of what it will be added to.
[[nodiscard]] Mat6 Resolvable(const Mat6& covariance, const Vec6& beside = Vec6::Zero()) noexcept;

}  // namespace disflow
