// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
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

  using Blocks = std::array<const PixelMoments*, 9>;  ///< Row by row.

  /// @param plane Fitted to all nine blocks together.
  /// @param full_pixels Pixels of a block without holes; the quadratic needs an even grid.
  /// @param noise_variance Per pixel [1/m^2].
  [[nodiscard]] static CurvedWindow Fit(const Blocks& blocks, const InverseDepthPlane& plane,
                                        float full_pixels, float noise_variance) noexcept {
    CurvedWindow window;
    constexpr float kFull = 0.9F;
    const float reference = blocks[4]->w_reference;
    float a = 0.0F;  // of x^2 - 2/3, with x and y in blocks: orthogonal to the plane's terms
    float b = 0.0F;  // of y^2 - 2/3
    float c = 0.0F;  // of x y
    for (int i = 0; i < 9; ++i) {
      const PixelMoments& moments = *blocks[static_cast<std::size_t>(i)];
      if (moments.n < kFull * full_pixels) return window;
      const float mean = moments.w_reference - reference + moments.w / moments.n;
      const int x = i % 3 - 1;
      const int y = i / 3 - 1;
      a += (static_cast<float>(x * x) - 2.0F / 3.0F) * mean;
      b += (static_cast<float>(y * y) - 2.0F / 3.0F) * mean;
      c += static_cast<float>(x * y) * mean;
    }
    a /= 2.0F;
    b /= 2.0F;
    c /= 4.0F;
    const float explained = full_pixels * (2.0F * a * a + 2.0F * b * b + 4.0F * c * c);
    window.residual_variance =
        std::fmax(plane.residual_variance * (plane.n - 3.0F) - explained, 0.0F) / (plane.n - 6.0F);
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
