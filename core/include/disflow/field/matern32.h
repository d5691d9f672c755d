// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/field/fast_math.h"
#include "disflow/types.h"

namespace disflow {

/// Joint covariance of value and gradient at two points under a Matern 3/2 kernel (section IV,
/// "Kernel Design").
///
/// In coordinates p = s (x - c) with s = sqrt(3) / length_scale and scaled distance s d the kernel
/// is k(r) = a^2 (1 + r) exp(-r), r = |p - p'|. Then the gradient by x equals the scaled value's
/// gradient by p, every quantity is without unit, and a is the prior standard deviation of the
/// gradient.
struct Matern32Block {
  Vec3 e;          ///< p - p'
  float r;         ///< |e|
  float envelope;  ///< a^2 exp(-r)

  [[nodiscard]] static Matern32Block At(const Vec3& p, const Vec3& q,
                                        float amplitude_squared) noexcept {
    const Vec3 e = p - q;
    const float r = e.norm();
    return {e, r, amplitude_squared * FastExpNonPositive(-r)};
  }

  /// cov(d(p), d(p'))
  [[nodiscard]] float ValueValue() const noexcept { return (1.0F + r) * envelope; }
  /// cov(d(p), grad d(p')); cov(grad d(p), d(p')) is its negative.
  [[nodiscard]] Vec3 ValueGradient() const noexcept { return envelope * e; }
  /// cov(grad d(p), grad d(p'))
  [[nodiscard]] Mat3 GradientGradient() const noexcept {
    constexpr float kCoincident = 1e-6F;  // the second term vanishes with r
    const float inverse_r = r > kCoincident ? 1.0F / r : 0.0F;
    return envelope * (Mat3::Identity() - inverse_r * e * e.transpose());
  }
};

}  // namespace disflow
