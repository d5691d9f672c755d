// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "disflow/types.h"

/// @file
/// Rigid-body motions SE(3): exponential, logarithm, adjoint and their derivatives.
///
/// Tangent vectors are ordered (translation rho, rotation theta), as the paper's xi in section V-D.
/// Increments are applied on the left: T <- exp(xi) T. Formulas: Sola et al., "A micro Lie theory
/// for state estimation in robotics" (arXiv:1812.01537), and Barfoot, "State Estimation for
/// Robotics", section 7.1.

namespace disflow {

template <class Scalar>
[[nodiscard]] inline Mat<Scalar, 3, 3> Skew(const Mat<Scalar, 3>& v) noexcept {
  Mat<Scalar, 3, 3> m;
  m << Scalar(0), -v.z(), v.y(), v.z(), Scalar(0), -v.x(), -v.y(), v.x(), Scalar(0);
  return m;
}

/// Coefficients of the series shared by the exponential and its Jacobians, exact near zero.
template <class Scalar>
struct So3Coefficients {
  Scalar a;  ///< sin(t) / t
  Scalar b;  ///< (1 - cos(t)) / t^2
  Scalar c;  ///< (t - sin(t)) / t^3

  [[nodiscard]] static So3Coefficients FromAngle(Scalar t) noexcept {
    const Scalar t2 = t * t;
    // Below this angle the direct quotients cancel; the next series term is smaller than rounding.
    if (t2 < Scalar(0.01)) {
      return {Scalar(1) -
                  t2 / Scalar(6) * (Scalar(1) - t2 / Scalar(20) * (Scalar(1) - t2 / Scalar(42))),
              Scalar(0.5) -
                  t2 / Scalar(24) * (Scalar(1) - t2 / Scalar(30) * (Scalar(1) - t2 / Scalar(56))),
              Scalar(1) / Scalar(6) -
                  t2 / Scalar(120) * (Scalar(1) - t2 / Scalar(42) * (Scalar(1) - t2 / Scalar(72)))};
    }
    using std::cos;
    using std::sin;
    return {sin(t) / t, (Scalar(1) - cos(t)) / t2, (t - sin(t)) / (t2 * t)};
  }
};

/// Rotation vector (axis times angle, rad) to rotation matrix.
template <class Scalar>
[[nodiscard]] inline Mat<Scalar, 3, 3> ExpSo3(const Mat<Scalar, 3>& theta) noexcept {
  const auto k = So3Coefficients<Scalar>::FromAngle(theta.norm());
  const Mat<Scalar, 3, 3> w = Skew(theta);
  return Mat<Scalar, 3, 3>::Identity() + k.a * w + k.b * w * w;
}

/// Rotation matrix to rotation vector, angle in [0, pi].
template <class Scalar>
[[nodiscard]] inline Mat<Scalar, 3> LogSo3(const Mat<Scalar, 3, 3>& rotation) noexcept {
  // Through the quaternion: well conditioned at 0 and at pi, where the matrix formulas are not.
  using std::atan2;
  Eigen::Quaternion<Scalar, Eigen::DontAlign> q(rotation);
  if (q.w() < Scalar(0)) q.coeffs() = -q.coeffs();
  const Scalar s = q.vec().norm();
  if (s < Scalar(1e-12)) return Scalar(2) * q.vec();
  return (Scalar(2) * atan2(s, q.w()) / s) * q.vec();
}

/// The rotation vector that leads from one rotation to the other: to = exp(turn) from.
template <class Scalar>
[[nodiscard]] inline Mat<Scalar, 3> TurnBetween(const Mat<Scalar, 3, 3>& from,
                                                const Mat<Scalar, 3, 3>& to) noexcept {
  return LogSo3<Scalar>(to * from.transpose());
}

/// Left Jacobian of SO(3): exp(theta + d) ~ exp(J_l(theta) d) exp(theta).
template <class Scalar>
[[nodiscard]] inline Mat<Scalar, 3, 3> LeftJacobianSo3(const Mat<Scalar, 3>& theta) noexcept {
  const auto k = So3Coefficients<Scalar>::FromAngle(theta.norm());
  const Mat<Scalar, 3, 3> w = Skew(theta);
  return Mat<Scalar, 3, 3>::Identity() + k.b * w + k.c * w * w;
}

template <class Scalar>
[[nodiscard]] inline Mat<Scalar, 3, 3> LeftJacobianInverseSo3(
    const Mat<Scalar, 3>& theta) noexcept {
  const auto k = So3Coefficients<Scalar>::FromAngle(theta.norm());
  const Scalar t2 = theta.squaredNorm();
  // (1/t^2)(1 - a / (2 b)); tends to 1/12.
  const Scalar e = t2 < Scalar(1e-4) ? Scalar(1) / Scalar(12) + t2 / Scalar(720)
                                     : (Scalar(1) - k.a / (Scalar(2) * k.b)) / t2;
  const Mat<Scalar, 3, 3> w = Skew(theta);
  return Mat<Scalar, 3, 3>::Identity() - Scalar(0.5) * w + e * w * w;
}

/// Rigid-body transform that maps coordinates in frame `From` to coordinates in frame `To` (x_to =
/// T x_from).
template <class To, class From, class Scalar = float>
class Transform {
 public:
  using Vector3 = Mat<Scalar, 3>;
  using Vector6 = Mat<Scalar, 6>;
  using Matrix3 = Mat<Scalar, 3, 3>;
  using Matrix6 = Mat<Scalar, 6, 6>;
  using Quaternion = Eigen::Quaternion<Scalar, Eigen::DontAlign>;

  Transform() noexcept : rotation_(Matrix3::Identity()), translation_(Vector3::Zero()) {}
  Transform(const Matrix3& rotation, const Vector3& translation) noexcept
      : rotation_(rotation), translation_(translation) {}
  Transform(const Quaternion& rotation, const Vector3& translation) noexcept
      : rotation_(rotation.normalized().toRotationMatrix()), translation_(translation) {}

  /// exp of xi = (rho, theta): the motion reached by following that twist for unit time.
  [[nodiscard]] static Transform Exp(const Vector6& xi) noexcept {
    const Vector3 theta = xi.template tail<3>();
    return {ExpSo3(theta), LeftJacobianSo3(theta) * xi.template head<3>()};
  }

  /// Inverse of Exp for rotation angles below pi.
  [[nodiscard]] Vector6 Log() const noexcept {
    Vector6 xi;
    const Vector3 theta = LogSo3(rotation_);
    xi.template tail<3>() = theta;
    xi.template head<3>() = LeftJacobianInverseSo3(theta) * translation_;
    return xi;
  }

  [[nodiscard]] Transform<From, To, Scalar> Inverse() const noexcept {
    const Matrix3 inverse = rotation_.transpose();
    return {inverse, Vector3(-(inverse * translation_))};
  }

  /// Moves a tangent vector from `From` to `To`: T exp(xi) T^-1 = exp(Ad xi). Order (rho, theta).
  [[nodiscard]] Matrix6 Adjoint() const noexcept {
    Matrix6 adjoint = Matrix6::Zero();
    adjoint.template topLeftCorner<3, 3>() = rotation_;
    adjoint.template bottomRightCorner<3, 3>() = rotation_;
    adjoint.template topRightCorner<3, 3>() = Skew(translation_) * rotation_;
    return adjoint;
  }

  /// The same motion with the rotation brought back onto SO(3) after many products.
  [[nodiscard]] Transform Normalized() const noexcept {
    return {rotation_quaternion(), translation_};
  }

  [[nodiscard]] bool IsFinite() const noexcept {
    return rotation_.allFinite() && translation_.allFinite();
  }

  template <class Other>
  [[nodiscard]] Transform<To, Other, Scalar> operator*(
      const Transform<From, Other, Scalar>& rhs) const noexcept {
    return {Matrix3(rotation_ * rhs.rotation()),
            Vector3(rotation_ * rhs.translation() + translation_)};
  }
  [[nodiscard]] Vector3 operator*(const Vector3& point) const noexcept {
    return rotation_ * point + translation_;
  }

  template <class NewScalar>
  [[nodiscard]] Transform<To, From, NewScalar> Cast() const noexcept {
    return {Mat<NewScalar, 3, 3>(rotation_.template cast<NewScalar>()),
            Mat<NewScalar, 3>(translation_.template cast<NewScalar>())};
  }

  [[nodiscard]] const Matrix3& rotation() const noexcept { return rotation_; }
  [[nodiscard]] const Vector3& translation() const noexcept { return translation_; }
  [[nodiscard]] Quaternion rotation_quaternion() const noexcept {
    return Quaternion(rotation_).normalized();
  }

 private:
  Matrix3 rotation_;
  Vector3 translation_;
};

using PoseObjectFromCamera = Transform<Object, Camera>;  ///< T_oc, the paper's pose (section III).
using PoseCameraFromObject = Transform<Camera, Object>;  ///< T_co, what leaves the apps.

}  // namespace disflow
