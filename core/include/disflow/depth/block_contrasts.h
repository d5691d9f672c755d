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

}  // namespace disflow
