// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"

/// @file
/// Double-precision poses and velocities of the simulator and of recorded ground truth.

namespace disflow::host {

using Vec3d = Mat<double, 3>;
using Mat3d = Mat<double, 3, 3>;

/// Whether a matrix that was printed with a few digits is a rotation.
[[nodiscard]] inline bool IsRotation(const Mat3d& m) {
  constexpr double kTolerance = 1e-2;
  // Written so that NaN is none.
  return (m.transpose() * m - Mat3d::Identity()).cwiseAbs().maxCoeff() < kTolerance &&
         m.determinant() > 0.0;
}

/// Where frame `B` is in frame `A` and how it moves there.
template <class A, class B>
struct RigidState {
  Transform<A, B, double> pose;       ///< T_ab.
  Vec3d linear_mps = Vec3d::Zero();   ///< Velocity of B's origin, in the axes of A.
  Vec3d angular_rps = Vec3d::Zero();  ///< Angular velocity of B relative to A, in the axes of A.
};

/// The motion of `C` as seen from the moving frame `B`.
template <class A, class B, class C>
[[nodiscard]] RigidState<B, C> SeenFrom(const RigidState<A, B>& observer,
                                        const RigidState<A, C>& body) {
  const Mat3d R_ba = observer.pose.rotation().transpose();
  const Vec3d offset = body.pose.translation() - observer.pose.translation();
  RigidState<B, C> seen;
  seen.pose = observer.pose.Inverse() * body.pose;
  seen.linear_mps =
      R_ba * (body.linear_mps - observer.linear_mps - observer.angular_rps.cross(offset));
  seen.angular_rps = R_ba * (body.angular_rps - observer.angular_rps);
  return seen;
}

}  // namespace disflow::host
