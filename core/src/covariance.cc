// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/geometry/covariance.h"

#include <cmath>

#include "disflow/geometry/transform.h"

namespace disflow {

Mat6 RotatedCovariance(const Mat6& covariance, const Mat3& rotation) noexcept {
  Mat6 jacobian = Mat6::Zero();
  jacobian.topLeftCorner<3, 3>() = rotation;
  jacobian.bottomRightCorner<3, 3>() = rotation;
  // Assigned instead of returned: Eigen sums in another order where a product initialises, and the
  // last bits of every twist depend on it.
  Mat6 rotated;
  rotated = jacobian * covariance * jacobian.transpose();
  return rotated;
}

Mat6 ScaledCovariance(const Mat6& covariance, float first, float second) noexcept {
  Vec6 scale;
  scale << Vec3::Constant(std::sqrt(first)), Vec3::Constant(std::sqrt(second));
  return scale.asDiagonal() * covariance * scale.asDiagonal();
}

Mat6 CovarianceAtPoint(const Mat6& covariance, const Mat3& rotation,
                       const Vec3& to_point_m) noexcept {
  Mat6 jacobian = Mat6::Zero();
  jacobian.topLeftCorner<3, 3>() = rotation;
  jacobian.topRightCorner<3, 3>() = -rotation * Skew(to_point_m);
  jacobian.bottomRightCorner<3, 3>() = rotation;
  return jacobian * covariance * jacobian.transpose();
}

Mat3 VelocityCovarianceOfPlace(const Mat3& place_m2, const Mat3& rate2_rps2) noexcept {
  Mat3 result = Mat3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const Mat3 about_i = Skew(Vec3(Vec3::Unit(i)));
      const Mat3 about_j = Skew(Vec3(Vec3::Unit(j)));
      result += rate2_rps2(i, j) * about_i * place_m2 * about_j.transpose();
    }
  }
  return result;
}

float LargestPositionStd(const Mat6& covariance) noexcept {
  return std::sqrt(covariance.diagonal().head<3>().maxCoeff());
}

float LargestRotationStd(const Mat6& covariance) noexcept {
  return std::sqrt(covariance.diagonal().tail<3>().maxCoeff());
}

Mat6 Resolvable(const Mat6& covariance, const Vec6& beside) noexcept {
  constexpr float kPrecision = 1e-6F;  // 8 times that of a float
  const Vec6 largest = covariance.diagonal().cwiseMax(beside);
  Mat6 result = covariance;
  result.diagonal().head<3>().array() += kPrecision * largest.head<3>().maxCoeff();
  result.diagonal().tail<3>().array() += kPrecision * largest.tail<3>().maxCoeff();
  return result;
}

}  // namespace disflow
