// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "disflow/field/fast_math.h"
#include "disflow/types.h"

namespace disflow {

struct GpHyperparameters {
  float length_scale_m;
  float prior_gradient_std;  ///< Of the gradient about the local plane.
};

/// The covariance function of the local GPs (section IV, "Kernel Design"): Matern 3/2. Whatever
/// depends on which kernel it is, is in this class.
///
/// In coordinates p = s (x - c) with s = sqrt(3) / length_scale and scaled distance s d the kernel
/// is k(r) = a^2 (1 + r) exp(-r), r = |p - p'|. Then the gradient by x equals the scaled value's
/// gradient by p, every quantity is without unit, and a is the prior standard deviation of the
/// gradient. Rasmussen and Williams, "Gaussian Processes for Machine Learning", equation (4.17).
class GpKernel {
 public:
  /// One number per sample.
  template <int kSamples>
  using Row = Eigen::Array<float, kSamples, 1, Eigen::DontAlign>;

  GpKernel() = default;  ///< Uninitialised, like the GP that holds it.
  explicit GpKernel(const GpHyperparameters& hyper) noexcept
      : scale_per_m_(std::sqrt(3.0F) / hyper.length_scale_m),
        amplitude_squared_(hyper.prior_gradient_std * hyper.prior_gradient_std) {}

  /// s [1/m]
  [[nodiscard]] float scale_per_m() const noexcept { return scale_per_m_; }
  /// Variance of the scaled distance, and of each component of the gradient, before anything was
  /// observed; they do not covary.
  [[nodiscard]] float prior_variance() const noexcept { return amplitude_squared_; }

  /// Joint covariance k~(p, p') of section IV: of (scaled d, grad d) at p, rows, and at q, columns.
  [[nodiscard]] Mat4 Covariance(const Vec3& p, const Vec3& q) const noexcept;

  /// k~_*^T alpha of equation (6), over all samples at once: the sum of Covariance(p, p_i) alpha_i.
  /// @param ex, ey, ez p - p_i
  /// @param alpha (scaled value, gradient) per sample; zero for samples that are not there.
  template <int kSamples>
  void Predict(const Row<kSamples>& ex, const Row<kSamples>& ey, const Row<kSamples>& ez,
               const std::array<Row<kSamples>, 4>& alpha, float& scaled_distance,
               Vec3& gradient) const noexcept {
    constexpr float kTiny = 1e-12F;  // keeps 1/r finite at a sample, where its term vanishes
    const Row<kSamples> r_squared = ex * ex + ey * ey + ez * ez + kTiny;
    Row<kSamples> inverse_r;
    Row<kSamples> envelope;
    for (int i = 0; i < kSamples; ++i) {
      inverse_r.data()[i] = FastInverseSqrt(r_squared.data()[i]);
      const float r = r_squared.data()[i] * inverse_r.data()[i];
      envelope.data()[i] = amplitude_squared_ * FastExpNonPositive(-r);
    }
    const Row<kSamples> along = ex * alpha[1] + ey * alpha[2] + ez * alpha[3];
    const Row<kSamples> value = envelope * ((1.0F + r_squared * inverse_r) * alpha[0] + along);
    scaled_distance = value.sum();
    const Row<kSamples> radial = envelope * (alpha[0] + along * inverse_r);
    gradient =
        Vec3((envelope * alpha[1] - radial * ex).sum(), (envelope * alpha[2] - radial * ey).sum(),
             (envelope * alpha[3] - radial * ez).sum());
  }

 private:
  float scale_per_m_;        ///< s
  float amplitude_squared_;  ///< a^2
};

/// Variance of the distance [m^2] at the end of a length over which nothing was seen: what the
/// prior's uncertain slope makes of it.
[[nodiscard]] inline float SlopeVariance(float prior_gradient_std, float length_m) noexcept {
  const float std_m = prior_gradient_std * length_m;
  return std_m * std_m;
}

}  // namespace disflow
