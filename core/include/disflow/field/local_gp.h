// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "disflow/field/cholesky.h"
#include "disflow/field/fast_math.h"
#include "disflow/field/matern32.h"
#include "disflow/memory/fixed_point.h"
#include "disflow/memory/packed_variance.h"
#include "disflow/types.h"

namespace disflow {

/// One surface constraint d(x) = 0 with its normal constraint grad d(x) = n (section IV, "Training
/// Constraints").
struct GpTrainingSample {
  Vec3 position_m;
  Vec3 normal;
  float value_variance_m2;  ///< Noise of d, sample and model together.
  float normal_variance;    ///< Noise of grad d, per component.
};

struct GpHyperparameters {
  float length_scale_m;
  float prior_gradient_std;  ///< Of the gradient about the local plane.
};

/// Gaussian-process implicit surface on at most kMaxSamples samples, with a local plane m(x) = n^T
/// (x - c) as prior mean. Holds what a prediction needs and no more; the covariance is refactored
/// on demand (Factorise()). Clear() it before first use.
template <int kMaxSamples>
class LocalGp {
 public:
  using Row = Eigen::Array<float, kMaxSamples, 1, Eigen::DontAlign>;

  /// Back to untrained.
  void Clear() noexcept { size_ = 0; }
  [[nodiscard]] bool trained() const noexcept { return size_ > 0; }
  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] const Vec3& center_m() const noexcept { return center_m_; }
  [[nodiscard]] const Vec3& mean_normal() const noexcept { return mean_normal_; }
  /// Posterior variance of d at center_m() [m^2].
  [[nodiscard]] float SurfaceVariance() const noexcept { return surface_variance_m2_; }

  /// Posterior mean of (d [m], grad d) at x: k_*^T (K + sigma^2 I)^-1 y plus the prior plane. Only
  /// for a trained GP.
  void Mean(const Vec3& x_m, float& distance_m, Vec3& gradient) const noexcept {
    const Vec3 offset_m = x_m - center_m_;
    const Vec3 p = scale_ * offset_m;
    const Row ex = Offsets(p, 0);
    const Row ey = Offsets(p, 1);
    const Row ez = Offsets(p, 2);
    constexpr float kTiny = 1e-12F;  // keeps 1/r finite at a sample, where its term vanishes
    const Row r_squared = ex * ex + ey * ey + ez * ez + kTiny;
    Row inverse_r;
    Row envelope;
    for (int i = 0; i < kMaxSamples; ++i) {
      inverse_r.data()[i] = FastInverseSqrt(r_squared.data()[i]);
      const float r = r_squared.data()[i] * inverse_r.data()[i];
      envelope.data()[i] = amplitude_squared_ * FastExpNonPositive(-r);
    }
    const Row along = ex * weight_[1] + ey * weight_[2] + ez * weight_[3];
    const Row value = envelope * ((1.0F + r_squared * inverse_r) * weight_[0] + along);
    distance_m = mean_normal_.dot(offset_m) + value.sum() / scale_;
    const Row radial = envelope * (weight_[0] + along * inverse_r);
    gradient = mean_normal_ + Vec3((envelope * weight_[1] - radial * ex).sum(),
                                   (envelope * weight_[2] - radial * ey).sum(),
                                   (envelope * weight_[3] - radial * ez).sum());
  }

 private:
  template <int kSamples>
  friend struct GpWorkspace;

  template <class T>
  using PerSample = std::array<T, static_cast<std::size_t>(kMaxSamples)>;

  /// p - p_i along one axis.
  [[nodiscard]] Row Offsets(const Vec3& p, int axis) const noexcept {
    Row offsets;
    const auto& steps = position_[static_cast<std::size_t>(axis)];
    for (int i = 0; i < kMaxSamples; ++i)
      offsets.data()[i] = p[axis] - step_ * static_cast<float>(steps[static_cast<std::size_t>(i)]);
    return offsets;
  }
  /// p_i
  [[nodiscard]] Vec3 Position(int i) const noexcept {
    const auto k = static_cast<std::size_t>(i);
    return step_ * Vec3(static_cast<float>(position_[0][k]), static_cast<float>(position_[1][k]),
                        static_cast<float>(position_[2][k]));
  }

  /// p of the samples in steps, unused ones zero. Rounded before the GP is trained, which thus
  /// knows where its samples are.
  std::array<PerSample<std::int16_t>, 3> position_;
  /// Scaled variances of the constraints, for refactoring.
  PerSample<PackedVariance> value_noise_;
  PerSample<PackedVariance> normal_noise_;
  /// alpha = (K + sigma^2 I)^-1 (y - m), value and gradient; unused ones zero. In full precision:
  /// large numbers of both signs that nearly cancel.
  std::array<Row, 4> weight_;
  Vec3 center_m_;
  Vec3 mean_normal_;
  float step_;               ///< Of position_, without unit like p.
  float scale_;              ///< s = sqrt(3) / length_scale [1/m]
  float amplitude_squared_;  ///< a^2
  float surface_variance_m2_;
  int size_;
};

/// Scratch memory for training and covariances; one serves all local GPs.
template <int kMaxSamples>
struct GpWorkspace {
  static constexpr int kRows = 4 * kMaxSamples;
  using Gp = LocalGp<kMaxSamples>;
  using Column = std::array<float, static_cast<std::size_t>(kRows)>;

  std::array<float, static_cast<std::size_t>(kRows* kRows)>
      factor;  ///< L of K + sigma^2 I, column-major.

  [[nodiscard]] bool Train(std::span<const GpTrainingSample> samples, const Vec3& center_m,
                           const Vec3& mean_normal, const GpHyperparameters& hyper,
                           Gp& gp) noexcept {
    gp.Clear();
    const auto count = static_cast<int>(samples.size());
    if (count == 0 || count > kMaxSamples) return false;
    gp.scale_ = std::sqrt(3.0F) / hyper.length_scale_m;
    gp.amplitude_squared_ = hyper.prior_gradient_std * hyper.prior_gradient_std;
    gp.center_m_ = center_m;
    gp.mean_normal_ = mean_normal;
    for (auto& row : gp.position_) row.fill(0);
    for (auto& row : gp.weight_) row.setZero();
    float farthest_m = 0.0F;
    for (const GpTrainingSample& sample : samples) {
      if (!IsUsable(sample)) return false;
      farthest_m = std::fmax(farthest_m, (sample.position_m - center_m).cwiseAbs().maxCoeff());
    }
    gp.step_ = std::fmax(gp.scale_ * farthest_m, kSmallestReach) / kMostSteps;
    if (!std::isfinite(gp.step_) || !std::isfinite(gp.scale_)) return false;
    Column y;
    for (int i = 0; i < count; ++i) {
      const GpTrainingSample& sample = samples[static_cast<std::size_t>(i)];
      const Vec3 offset_m = sample.position_m - center_m;
      const auto place = static_cast<std::size_t>(i);
      for (int axis = 0; axis < 3; ++axis) {
        gp.position_[static_cast<std::size_t>(axis)][place] =
            RoundToSteps(gp.scale_ * offset_m[axis] / gp.step_);
      }
      gp.value_noise_[place] = PackedVariance(gp.scale_ * gp.scale_ * sample.value_variance_m2);
      gp.normal_noise_[place] = PackedVariance(sample.normal_variance);
      // Residuals of the constraints d = 0 and grad d = n about the prior plane.
      Set(y, i, -gp.scale_ * mean_normal.dot(offset_m), sample.normal - mean_normal);
    }
    if (!FactoriseRows(gp, count)) return false;
    CholeskySolveLower(factor.data(), 4 * count, kRows, y.data());
    CholeskySolveUpper(factor.data(), 4 * count, kRows, y.data());
    for (int i = 0; i < count; ++i) {
      for (int k = 0; k < 4; ++k) {
        const float weight = y[static_cast<std::size_t>(4 * i + k)];
        if (!std::isfinite(weight)) return false;  // normals do not enter K: a NaN shows only here
        gp.weight_[static_cast<std::size_t>(k)][i] = weight;
      }
    }
    gp.size_ = count;
    gp.surface_variance_m2_ = Covariance(gp, center_m)(0, 0);
    return true;
  }

  /// Restores the factor of a trained GP, for Covariance().
  [[nodiscard]] bool Factorise(const Gp& gp) noexcept {
    return gp.size_ > 0 && FactoriseRows(gp, gp.size_);
  }

  /// Posterior covariance of (d [m], grad d) at x: k(x, x) - k_*^T (K + sigma^2 I)^-1 k_*. Needs
  /// this GP's factor.
  [[nodiscard]] Mat4 Covariance(const Gp& gp, const Vec3& x_m) const noexcept {
    const Vec3 p = gp.scale_ * (x_m - gp.center_m_);
    std::array<Column, 4> k;
    for (int i = 0; i < gp.size_; ++i) {
      const auto block = Matern32Block::At(p, gp.Position(i), gp.amplitude_squared_);
      Set(k[0], i, block.ValueValue(), block.ValueGradient());
      const Mat3 gradient_gradient = block.GradientGradient();
      for (int axis = 0; axis < 3; ++axis) {
        Set(k[static_cast<std::size_t>(axis + 1)], i, -block.ValueGradient()[axis],
            gradient_gradient.row(axis).transpose());
      }
    }
    for (Column& column : k) CholeskySolveLower(factor.data(), 4 * gp.size_, kRows, column.data());
    Mat4 covariance;
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        float explained = 0.0F;
        for (std::size_t i = 0; i < static_cast<std::size_t>(4 * gp.size_); ++i)
          explained += k[a][i] * k[b][i];
        const float prior = a == b ? gp.amplitude_squared_ : 0.0F;
        // Back to SI units: d = scaled value / s.
        const float unit = (a == 0 ? 1.0F / gp.scale_ : 1.0F) * (b == 0 ? 1.0F / gp.scale_ : 1.0F);
        const auto row = static_cast<int>(a);
        const auto column = static_cast<int>(b);
        const float value = prior - explained;
        // Rounding must not make a variance negative where the data leave nothing open.
        const float bounded =
            a == b ? std::fmax(value, kSmallestShare * gp.amplitude_squared_) : value;
        covariance(row, column) = covariance(column, row) = unit * bounded;
      }
    }
    return covariance;
  }

 private:
  static constexpr float kSmallestShare = 1e-6F;
  static constexpr float kSmallestReach = 1e-6F;  ///< Of p, for samples that are all in one place.

  /// What packing would hide: NaN, infinity, negative variances. Normals are not packed.
  [[nodiscard]] static bool IsUsable(const GpTrainingSample& sample) noexcept {
    return sample.position_m.allFinite() && sample.value_variance_m2 >= 0.0F &&
           sample.normal_variance >= 0.0F && std::isfinite(sample.value_variance_m2) &&
           std::isfinite(sample.normal_variance);
  }
  static void Set(Column& column, int i, float value, const Vec3& gradient) noexcept {
    const auto row = static_cast<std::size_t>(4 * i);
    column[row] = value;
    for (std::size_t k = 0; k < 3; ++k) column[row + 1 + k] = gradient[static_cast<int>(k)];
  }

  /// Fills the lower triangle of K + sigma^2 I and factorises it.
  [[nodiscard]] bool FactoriseRows(const Gp& gp, int count) noexcept {
    for (int j = 0; j < count; ++j) {
      for (int i = j; i < count; ++i) {
        const auto block = Matern32Block::At(gp.Position(i), gp.Position(j), gp.amplitude_squared_);
        Mat4 k;
        k(0, 0) = block.ValueValue();
        k.template block<1, 3>(0, 1) = block.ValueGradient().transpose();
        k.template block<3, 1>(1, 0) = -block.ValueGradient();
        k.template block<3, 3>(1, 1) = block.GradientGradient();
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

/// Trains a local GP.
/// @return false if there are no samples or more than kMaxSamples, if anything is not finite, or if
/// the covariance is not positive definite; the GP is then untrained.
template <int kMaxSamples>
[[nodiscard]] bool Train(std::span<const GpTrainingSample> samples, const Vec3& center_m,
                         const Vec3& mean_normal, const GpHyperparameters& hyper,
                         GpWorkspace<kMaxSamples>& workspace, LocalGp<kMaxSamples>& gp) noexcept {
  return workspace.Train(samples, center_m, mean_normal, hyper, gp);
}

/// Restores the factor of a trained GP, to be called once before Covariance().
template <int kMaxSamples>
[[nodiscard]] bool Factorise(const LocalGp<kMaxSamples>& gp, const GpHyperparameters&,
                             GpWorkspace<kMaxSamples>& workspace) noexcept {
  return workspace.Factorise(gp);
}

/// Posterior covariance of (d [m], grad d) at x.
template <int kMaxSamples>
[[nodiscard]] Mat4 Covariance(const LocalGp<kMaxSamples>& gp, const GpHyperparameters&,
                              const GpWorkspace<kMaxSamples>& workspace, const Vec3& x_m) noexcept {
  return workspace.Covariance(gp, x_m);
}

}  // namespace disflow
