// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/estimate.h"
#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// What the residuals of one registration tell of (position of the centre, rotation), and what they
/// only seem to tell. Object axes, about the same centre.
struct RegistrationInformation {
  Mat6 total = Mat6::Zero();    ///< H = sum w J^T J of samples and edges.
  Mat6 surface = Mat6::Zero();  ///< What of it the samples contribute, the edges the rest.
  /// What the samples would contribute to H if their gradients pointed anywhere across the true
  /// ones, per squared radian that they are off.
  Mat6 across = Mat6::Zero();
  /// How far they are off, as the normals of this frame's samples show it [rad^2].
  float gradient_variance_rad2 = 0.0F;
  /// What edges contribute to H by errors of their directions and depths: pieces of a bent line,
  /// each taken for straight, and the outlines of a can's side, where there is no edge, seem to
  /// tell its turn.
  Mat6 of_edge_errors = Mat6::Zero();
};

/// How well one registration knows the pose.
struct PoseUncertainty {
  Mat6 covariance = Mat6::Zero();  ///< Of (position, rotation).
  /// The same without what it lets happen along directions of which nothing is told: how far the
  /// object can have moved along them is a matter of time.
  Mat6 of_observed = Mat6::Zero();
  /// Sum of u u^T over the directions u of which neither surface nor edges tell anything, each as
  /// far as an object may move along it in a second. Zero when there are none.
  Mat6 unobserved = Mat6::Zero();
  /// What of it are turns about an axis of the object's own.
  Mat6 free_turn = Mat6::Zero();
  bool solved = false;  ///< False when the information is not finite.

  [[nodiscard]] bool IsComplete() const noexcept { return unobserved.isZero(0.0F); }
  /// Whether one of the unobserved directions is more than a turn about such an axis.
  [[nodiscard]] bool MayShift() const noexcept { return !(unobserved - free_turn).isZero(0.0F); }
};

/// Covariance from information with errors in the variables: a gradient that is off by a small
/// angle looks as if a can's side told a rotation about the can's axis, and an edge that runs a
/// little otherwise as if its lid did. What such errors explain is taken off the information, but
/// no more of either than it tells; directions of which they explain half and more count as
/// unobserved.
/// Fuller, "Measurement Error Models", section 1.2.
/// @param least_gradient_std Error of the field's gradients where the frame shows none, rad.
[[nodiscard]] PoseUncertainty FindPoseUncertainty(const RegistrationInformation& information,
                                                  float least_gradient_std) noexcept;

/// A twist without its turn about axes of `free_turn`, nor the way of the origin that comes of it.
[[nodiscard]] Twist WithoutTurn(const Twist& twist, const Mat6& free_turn) noexcept;

/// A twist as far as the surface tells it. About an axis of which nothing has told for some time
/// registration follows noise: a can seems to turn by hundreds of degrees per second, and looks the
/// same. It is taken for one that does not turn about it.
/// @param free_turn As PoseUncertainty::free_turn; of the object's origin, camera axes.
[[nodiscard]] Twist KnownTwist(const Twist& twist, const Mat6& free_turn,
                               float unobserved_s) noexcept;

/// What is remembered of RegistrationInformation::gradient_variance_rad2 after a frame. The model's
/// normals change slowly; one frame that happens to agree with them makes them no better.
[[nodiscard]] float RememberGradientVariance(float before_rad2, float by_frame_rad2) noexcept;

/// The covariance of a pose that turns by an uncertain angle. One that is linear in the angle has
/// the point fly off along its tangent: the point stays on its circle, and no angle is more than
/// half a turn. Of the turn about the axis about which it is largest, which is taken to be anything
/// up to a bound; what else is uncertain stays as it is.
/// @param covariance Of (displacement of the point, theta).
/// @return Second moments of the same about where the point is.
[[nodiscard]] Mat6 OnItsArc(const Mat6& covariance) noexcept;

}  // namespace disflow
