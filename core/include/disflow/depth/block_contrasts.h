// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace disflow {

/// Means of inverse depth of 3x3 neighbouring pixel blocks, row by row [1/m].
using BlockMeans = std::array<float, 9>;

/// Variance of a block's mean, from differences that no surface of second order has: the contrasts
/// u^2 v, u v^2 and u^2 v^2 of the nine means. Planes, cylinders and spheres cancel; what is left
/// is noise at the scale of the blocks, with all its correlation between the pixels of a block.
/// @return The mean of the three squared contrasts, each divided by the variance that it has where
/// the means' is one [1/m^2]. Where the noise of neighbouring blocks is correlated too, this is
/// less than the variance of a mean.
[[nodiscard]] float ThirdOrderVariance(const BlockMeans& means) noexcept;

/// The median of ThirdOrderVariance() over many windows, as a share of its mean: that of
/// chi-squared with three degrees of freedom, divided by three.
inline constexpr float kThirdOrderMedian = 0.789F;

/// How many times the variance of a block's mean is what ThirdOrderVariance() says of it, where
/// noise goes on from block to block.
/// @param growth How many times larger that variance, times the pixels of a block, is for blocks
///     twice as wide: 1 for white noise. The answer follows it alone, within a tenth, for Gaussian
///     correlation exp(-r^2 / (4 s^2)) of any s up to 0.9 blocks. What grows by more is not noise
///     but surface of third order, and answered by 1.
[[nodiscard]] float CorrelationFactor(float growth) noexcept;

}  // namespace disflow
