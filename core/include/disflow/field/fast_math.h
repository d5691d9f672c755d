// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

/// @file
/// Elementary functions for the hot loop of the local GPs. Free of branches, calls, tables and
/// processor-specific estimates: compilers vectorise loops over them on every target, and without
/// contraction to fused operations (as core is built) every processor gives the same bits (the
/// instruction behind Eigen's packet sqrt, rsqrtps, does not).

namespace disflow {

/// exp(x) for x <= 0, relative error below 5e-7; 0 below -80 and for NaN.
[[nodiscard]] inline float FastExpNonPositive(float x) noexcept {
  constexpr float kLowest = -80.0F;
  constexpr float kLog2e = 1.44269504F;
  // ln 2 in two parts; products of the first with small integers are exact.
  constexpr float kLn2High = 0.693359375F;
  constexpr float kLn2Low = -2.12194440e-4F;
  // Adding 1.5 * 2^23 leaves the nearest integer in the lowest bits of the mantissa.
  constexpr float kRounder = 12582912.0F;
  constexpr int kMantissaBits = 23;

  const float shifted = x * kLog2e + kRounder;
  const float n = shifted - kRounder;
  const float f = (x - n * kLn2High) - n * kLn2Low;
  // exp(f) on |f| <= ln(2) / 2: minimax in the relative error (1.1e-7), exact at zero.
  const float tail = 0.499992288F + f * (0.166671163F + f * (0.0418905531F + f * 0.00831247971F));
  const float mantissa = 1.0F + (f + f * f * tail);
  // Times 2^n by adding n to the exponent; the rounder's other bits are shifted out.
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(mantissa) +
                             (std::bit_cast<std::uint32_t>(shifted) << kMantissaBits);
  // A mask, since compilers make a branch of a conditional expression here.
  const std::uint32_t keep = 0U - static_cast<std::uint32_t>(x > kLowest);
  return std::bit_cast<float>(bits & keep);
}

/// 1 / sqrt(x) for normal x > 0 below 1e37, relative error below 3e-7.
[[nodiscard]] inline float FastInverseSqrt(float x) noexcept {
  // Halving and negating the exponent gives 1/sqrt within 4 %; the constant minimises the error
  // that the first step leaves.
  constexpr std::uint32_t kEstimate = 0x5F375A80U;
  const float estimate = std::bit_cast<float>(kEstimate - (std::bit_cast<std::uint32_t>(x) >> 1U));
  // One step of second and one of third order: 4e-2 -> 2e-3 -> 1e-8.
  const float y = estimate * (1.5F - 0.5F * x * estimate * estimate);
  const float error = 1.0F - x * y * y;
  return y + y * error * (0.5F + 0.375F * error);
}

}  // namespace disflow
