// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "nearest_surface.h"
#include "surface.h"

namespace disflow::apps {

/// How well the standard deviations of a reconstructed surface predict its errors. Of a truthful
/// surface 68.3, 95.4 and 99.7 % of the vertices lie within one, two and three standard deviations
/// of the model.
struct SurfaceCalibration {
  /// Vertices whose standard deviations are alike.
  struct Bin {
    double std_m = 0.0;    ///< Root mean square of what they state.
    double error_m = 0.0;  ///< Root mean square of their distances to the model.
  };

  std::size_t vertices = 0;              ///< Judged ones.
  std::array<double, 3> share_within{};  ///< 0..1, within 1, 2, 3 standard deviations.
  double std_m = 0.0;                    ///< Root mean square over all.
  double error_m = 0.0;                  ///< Root mean square over all.
  std::vector<Bin> bins;                 ///< Ten of equal count, from certain to uncertain.
};

/// @param mesh In the model's frame, with standard deviations.
/// @param model_seen Whether each sample of `model` was seen; a vertex is judged if the sample
/// nearest to it was. Empty = not known, all are judged.
/// @return Nothing if the mesh states no standard deviations or no vertex can be judged.
[[nodiscard]] std::optional<SurfaceCalibration> CalibrateSurface(
    const Surface& mesh, const NearestSurface& model, const std::vector<bool>& model_seen);

}  // namespace disflow::apps
