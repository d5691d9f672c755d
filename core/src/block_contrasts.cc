// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/block_contrasts.h"

#include <cstddef>

namespace disflow {
namespace {

// Per axis, over the three blocks: first and second difference.
constexpr std::array<float, 3> kSlope{-1.0F, 0.0F, 1.0F};
constexpr std::array<float, 3> kBend{1.0F, -2.0F, 1.0F};

float Square(const BlockMeans& means, const std::array<float, 3>& along_u,
             const std::array<float, 3>& along_v) noexcept {
  float contrast = 0.0F;
  float gain = 0.0F;  // variance of the contrast where that of the means is one
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const float weight = along_u[column] * along_v[row];
      // Relative to the middle: the differences are small, the means are not.
      contrast += weight * (means[3 * row + column] - means[4]);
      gain += weight * weight;
    }
  }
  return contrast * contrast / gain;
}

}  // namespace

float ThirdOrderVariance(const BlockMeans& means) noexcept {
  return (Square(means, kBend, kSlope) + Square(means, kSlope, kBend) +
          Square(means, kBend, kBend)) /
         3.0F;
}

float CorrelationFactor(float growth) noexcept {
  constexpr float kMostOfNoise = 24.0F;
  const float more = growth - 1.0F;
  if (!(more > 0.0F) || growth > kMostOfNoise) return 1.0F;
  return 1.0F + more * (0.58F + 0.0135F * more);
}

}  // namespace disflow
