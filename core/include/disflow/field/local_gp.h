// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "disflow/field/gp_kernel.h"
#include "disflow/memory/packed_variance.h"
#include "disflow/types.h"

namespace disflow {

/// Gaussian-process implicit surface on at most kMaxSamples samples, with a local plane m(x) = n^T
/// (x - c) as prior mean. Holds what a prediction needs and no more: GpWorkspace trains it, and
/// refactors its covariance on demand. Clear() it before first use.
template <int kMaxSamples>
class LocalGp {
 public:
  using Row = GpKernel::Row<kMaxSamples>;

  /// Back to untrained.
  void Clear() noexcept { size_ = 0; }
  [[nodiscard]] bool trained() const noexcept { return size_ > 0; }
  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] const Vec3& center_m() const noexcept { return center_m_; }
  [[nodiscard]] const Vec3& mean_normal() const noexcept { return mean_normal_; }
  /// Posterior variance of d at center_m() [m^2].
  [[nodiscard]] float SurfaceVariance() const noexcept { return surface_variance_m2_; }

  /// Posterior mean of (d [m], grad d) at x, equation (6): k~_*^T (K~ + sigma^2 I)^-1 y plus the
  /// prior plane. Only for a trained GP.
  void Mean(const Vec3& x_m, float& distance_m, Vec3& gradient) const noexcept {
    const Vec3 offset_m = x_m - center_m_;
    const Vec3 p = kernel_.scale_per_m() * offset_m;
    float scaled_distance = 0.0F;
    Vec3 deviation;
    kernel_.Predict<kMaxSamples>(Offsets(p, 0), Offsets(p, 1), Offsets(p, 2), alpha_,
                                 scaled_distance, deviation);
    distance_m = mean_normal_.dot(offset_m) + scaled_distance / kernel_.scale_per_m();
    gradient = mean_normal_ + deviation;
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
  /// alpha = (K~ + sigma^2 I)^-1 (y - m), value and gradient; unused ones zero. In full precision:
  /// large numbers of both signs that nearly cancel.
  std::array<Row, 4> alpha_;
  Vec3 center_m_;
  Vec3 mean_normal_;
  float step_;  ///< Of position_, without unit like p.
  GpKernel kernel_;
  float surface_variance_m2_;
  int size_;
};

}  // namespace disflow
