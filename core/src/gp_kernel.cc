// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/gp_kernel.h"

namespace disflow {

Mat4 GpKernel::Covariance(const Vec3& p, const Vec3& q) const noexcept {
  constexpr float kCoincident = 1e-6F;  // the second term of the gradients' vanishes with r
  const Vec3 e = p - q;
  const float r = e.norm();
  const float envelope = amplitude_squared_ * FastExpNonPositive(-r);
  const float inverse_r = r > kCoincident ? 1.0F / r : 0.0F;
  const Vec3 value_gradient = envelope * e;
  Mat4 k;
  k(0, 0) = (1.0F + r) * envelope;
  k.block<1, 3>(0, 1) = value_gradient.transpose();
  k.block<3, 1>(1, 0) = -value_gradient;
  k.block<3, 3>(1, 1) = envelope * (Mat3::Identity() - inverse_r * e * e.transpose());
  return k;
}

}  // namespace disflow
