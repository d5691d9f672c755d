// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

namespace disflow::host {

/// A rectified image pair of 8-bit grey levels, as float.
struct StereoPair {
  std::span<const float> left;
  std::span<const float> right;
  int width_px = 0;
  int height_px = 0;
};

/// Improves each disparity by itself: Gauss-Newton on the difference of two windows (7 x 7 px,
/// weighted by a Gaussian) whose brightness and contrast are made equal, which is the gradient
/// ascent of their normalised correlation; the right image is interpolated by cubics.
/// @param disparity_px Left pixel u is right pixel u - d; < 0 = none. What strays by more than a
/// pixel or does not correlate becomes none.
void RefineDisparities(const StereoPair& pair, std::vector<float>& disparity_px);

}  // namespace disflow::host
