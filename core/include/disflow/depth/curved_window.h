// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/depth/inverse_depth_block.h"

namespace disflow {

/// The second-order part of inverse depth over a block and its eight neighbours. Curved surface
/// lies off the plane that is fitted to such a window, most of all in the middle, where the sample
/// is taken; the plane's slopes are right there all the same.
struct CurvedWindow {
  bool valid = false;
  float bend = 0.0F;  ///< Of the surface from the plane at the centre, shrunk by its noise [1/m].
  float residual_variance = 0.0F;  ///< Per pixel, about the curved surface [1/m^2].

  /// Over the nine blocks, with x and y their places in blocks from the middle.
  struct Sums {
    float fewest;  ///< Pixels of a block.
    float a;       ///< Means of inverse depth times x^2 - 2/3: orthogonal to the plane's terms.
    float b;       ///< Times y^2 - 2/3.
    float c;       ///< Times x y.
  };

  /// @param plane Fitted to all nine blocks together.
  /// @param full_pixels Pixels of a block without holes; the quadratic needs an even grid.
  /// @param noise_variance Per pixel [1/m^2].
  [[nodiscard]] static CurvedWindow Fit(const Sums& sums, const InverseDepthPlane& plane,
                                        float full_pixels, float noise_variance) noexcept {
    CurvedWindow window;
    constexpr float kFull = 0.9F;
    if (!(sums.fewest >= kFull * full_pixels)) return window;
    const float a = sums.a / 2.0F;
    const float b = sums.b / 2.0F;
    const float c = sums.c / 4.0F;
    const float explained = full_pixels * (2.0F * a * a + 2.0F * b * b + 4.0F * c * c);
    window.residual_variance =
        std::max(0.0F, plane.residual_variance * (plane.n - 3.0F) - explained) / (plane.n - 6.0F);
    const float variance = noise_variance / (2.0F * full_pixels);
    window.bend = -2.0F / 3.0F * (Shrunk(a, variance) + Shrunk(b, variance));
    window.valid = true;
    return window;
  }

  /// A measured value as far as it stands out of its noise (James and Stein).
  [[nodiscard]] static float Shrunk(float value, float variance) noexcept {
    const float square = value * value;
    return square > variance ? value * (1.0F - variance / square) : 0.0F;
  }
};

}  // namespace disflow
