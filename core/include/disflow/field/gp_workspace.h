// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <span>

#include "disflow/field/cholesky.h"
#include "disflow/field/local_gp.h"
#include "disflow/memory/fixed_point.h"

namespace disflow {

/// One surface constraint d(x) = 0 with its normal constraint grad d(x) = n (section IV, "Training
/// Constraints").
struct GpTrainingSample {
  Vec3 position_m;
  Vec3 normal;
  float value_variance_m2;  ///< Noise of d, sample and model together.
  float normal_variance;    ///< Noise of grad d, per component.
};

/// What packing would hide: NaN, infinity, negative variances. Normals are not packed.
[[nodiscard]] bool IsUsable(const GpTrainingSample& sample) noexcept;

/// Trains local GPs and computes their covariances; one serves them all. Scratch memory.
template <int kMaxSamples>
struct GpWorkspace {
  static constexpr int kRows = 4 * kMaxSamples;
  using Gp = LocalGp<kMaxSamples>;
  using Column = std::array<float, static_cast<std::size_t>(kRows)>;

  std::array<float, static_cast<std::size_t>(kRows* kRows)>
      factor;  ///< L of K~ + sigma^2 I, column-major.

  /// Trains a local GP.
  /// @return false if there are no samples or more than kMaxSamples, if anything is not finite, or
  /// if the covariance is not positive definite; the GP is then untrained.
  [[nodiscard]] bool Train(std::span<const GpTrainingSample> samples, const Vec3& center_m,
                           const Vec3& mean_normal, const GpHyperparameters& hyper,
                           Gp& gp) noexcept {
    gp.Clear();
    const auto count = static_cast<int>(samples.size());
    if (count == 0 || count > kMaxSamples) return false;
    gp.kernel_ = GpKernel(hyper);
    gp.center_m_ = center_m;
    gp.mean_normal_ = mean_normal;
    for (auto& row : gp.position_) row.fill(0);
    for (auto& row : gp.alpha_) row.setZero();
    float farthest_m = 0.0F;
    for (const GpTrainingSample& sample : samples) {
      if (!IsUsable(sample)) return false;
      farthest_m = std::fmax(farthest_m, (sample.position_m - center_m).cwiseAbs().maxCoeff());
    }
    const float scale = gp.kernel_.scale_per_m();
    gp.step_ = std::fmax(scale * farthest_m, kMinReach) / kMostSteps;
    if (!std::isfinite(gp.step_) || !std::isfinite(scale)) return false;
    Column y;
    for (int i = 0; i < count; ++i) {
      const GpTrainingSample& sample = samples[static_cast<std::size_t>(i)];
      const Vec3 offset_m = sample.position_m - center_m;
      const auto place = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 3; ++axis) {
        gp.position_[static_cast<std::size_t>(axis)][place] =
            RoundToSteps(scale * offset_m[axis] / gp.step_);
      }
      gp.value_noise_[place] = PackedVariance(scale * scale * sample.value_variance_m2);
      gp.normal_noise_[place] = PackedVariance(sample.normal_variance);
      // Residuals of the constraints d = 0 and grad d = n about the prior plane.
      y[4 * place] = -scale * mean_normal.dot(offset_m);
      for (int axis = 0; axis < 3; ++axis) {
        y[4 * place + 1 + static_cast<std::size_t>(axis)] = sample.normal[axis] - mean_normal[axis];
      }
    }
    if (!FactoriseRows(gp, count)) return false;
    CholeskySolveLower(factor.data(), 4 * count, kRows, y.data());
    CholeskySolveUpper(factor.data(), 4 * count, kRows, y.data());
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < 4; ++k) {
        const float weight = y[static_cast<std::size_t>(4 * i + k)];
        if (!std::isfinite(weight)) return false;  // normals do not enter K: a NaN shows only here
        gp.alpha_[static_cast<std::size_t>(k)][i] = weight;
      }
    }
    gp.size_ = count;
    gp.surface_variance_m2_ = Variance(gp, center_m);
    return true;
  }

  /// Restores the factor of a trained GP, to be called once before Covariance().
  /// @return false if the GP is not trained.
  [[nodiscard]] bool Factorise(const Gp& gp) noexcept {
    return gp.size_ > 0 && FactoriseRows(gp, gp.size_);
  }

  /// Posterior variance of d [m^2] at x: Covariance()(0, 0), for a quarter of the work.
  [[nodiscard]] float Variance(const Gp& gp, const Vec3& x_m) const noexcept {
    const float scale = gp.kernel_.scale_per_m();
    const Vec3 p = scale * (x_m - gp.center_m_);
    Column k;
    for (int i = 0; i < gp.size_; ++i) {
      const Mat4 block = gp.kernel_.Covariance(p, gp.Position(i));
      for (int column = 0; column < 4; ++column)
        k[static_cast<std::size_t>(4 * i + column)] = block(0, column);
    }
    CholeskySolveLower(factor.data(), 4 * gp.size_, kRows, k.data());
    float explained = 0.0F;
    for (std::size_t i = 0; i < static_cast<std::size_t>(4 * gp.size_); ++i)
      explained += k[i] * k[i];
    const float prior = gp.kernel_.prior_variance();
    return (1.0F / scale) * (1.0F / scale) * std::fmax(prior - explained, kMinShare * prior);
  }

  /// Posterior covariance of (d [m], grad d) at x, equation (7): k~(x, x) - k~_*^T (K~ + sigma^2
  /// I)^-1 k~_*. Needs this GP's factor.
  [[nodiscard]] Mat4 Covariance(const Gp& gp, const Vec3& x_m) const noexcept {
    const float scale = gp.kernel_.scale_per_m();
    const Vec3 p = scale * (x_m - gp.center_m_);
    std::array<Column, 4> k;  // k~_* by columns
    for (int i = 0; i < gp.size_; ++i) {
      const Mat4 block = gp.kernel_.Covariance(p, gp.Position(i));
      for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
          k[static_cast<std::size_t>(row)][static_cast<std::size_t>(4 * i + column)] =
              block(row, column);
        }
      }
    }
    for (Column& column : k) CholeskySolveLower(factor.data(), 4 * gp.size_, kRows, column.data());
    Mat4 covariance;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        float explained = 0.0F;
        for (std::size_t i = 0; i < static_cast<std::size_t>(4 * gp.size_); ++i)
          explained += k[a][i] * k[b][i];
        const float prior = a == b ? gp.kernel_.prior_variance() : 0.0F;
        // Back to SI units: d = scaled value / s.
        const float unit = (a == 0 ? 1.0F / scale : 1.0F) * (b == 0 ? 1.0F / scale : 1.0F);
        const auto row = static_cast<int>(a);
        const auto column = static_cast<int>(b);
        const float value = prior - explained;
        // Rounding must not make a variance negative where the data leave nothing open.
        const float bounded =
            a == b ? std::fmax(value, kMinShare * gp.kernel_.prior_variance()) : value;
        covariance(row, column) = covariance(column, row) = unit * bounded;
      }
    }
    return covariance;
  }

 private:
  static constexpr float kMinShare = 1e-6F;  ///< Of the prior's variance: float's rounding.
  static constexpr float kMinReach = 1e-6F;  ///< Of p, for samples that are all in one place.

  /// Fills the lower triangle of K~ + sigma^2 I and factorises it.
  [[nodiscard]] bool FactoriseRows(const Gp& gp, int count) noexcept {
    for (int j = 0; j < count; ++j) {
      for (int i = j; i < count; ++i) {
        Mat4 k = gp.kernel_.Covariance(gp.Position(i), gp.Position(j));
        if (i == j) {
          const auto place = static_cast<std::size_t>(i);
          const float normal_noise = gp.normal_noise_[place].value();
          k.diagonal() +=
              Vec4(gp.value_noise_[place].value(), normal_noise, normal_noise, normal_noise);
        }
        for (int column = 0; column < 4; ++column) {
          for (int row = 0; row < 4; ++row) {
            factor[static_cast<std::size_t>((4 * j + column) * kRows + 4 * i + row)] =
                k(row, column);
          }
        }
      }
    }
    return CholeskyFactorise(factor.data(), 4 * count, kRows);
  }
};

}  // namespace disflow
