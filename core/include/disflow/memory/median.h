// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace disflow {

/// Median of the absolute values of a normal distribution, in its standard deviations.
inline constexpr float kMedianPerSigma = 0.6745F;

/// Of an even number the upper of the two in the middle; 0 if there are none. Reorders them.
[[nodiscard]] inline float MedianOf(float* begin, float* end) noexcept {
  if (begin == end) return 0.0F;
  float* middle = begin + (end - begin) / 2;
  std::nth_element(begin, middle, end);
  return *middle;
}

}  // namespace disflow
