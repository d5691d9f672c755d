// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "surface.h"

namespace disflow::apps {

/// Distances at which the F-score counts a point as right.
inline constexpr std::array<double, 3> kFScoreDistances_m = {0.001, 0.002, 0.005};

/// Points spread over each surface when they are compared.
inline constexpr std::size_t kMeshSamples = 50000;

/// How well a reconstructed surface and the model agree. NaN where nothing could be compared.
struct MeshMetrics {
  double accuracy_m = 0.0;          ///< Mean distance from the mesh to the model.
  double completeness_m = 0.0;      ///< Mean distance from the model to the mesh.
  double chamfer_m = 0.0;           ///< Mean of the two.
  double hausdorff_m = 0.0;         ///< Largest distance, both ways.
  std::array<double, 3> f_score{};  ///< 0..1, harmonic mean of precision and recall, per distance.
  double mesh_to_model_normal_rad = 0.0;  ///< Mean angle between normals; NaN if unknown.
  double model_to_mesh_normal_rad = 0.0;
};

/// The comparison over all of the surface and over the part of the model that was seen.
struct MeshComparison {
  MeshMetrics whole;
  MeshMetrics seen;         ///< NaN if it is not known what was seen.
  double seen_share = 0.0;  ///< Part of the model's surface that was seen, 0..1; NaN if not known.
};

/// @param mesh In the model's frame.
/// @param model_samples Points spread over the model.
/// @param model_seen Whether each of them was seen; empty = not known. The part of the mesh that
/// counts as seen is what lies nearest to a seen point of the model.
[[nodiscard]] MeshComparison CompareMeshes(const Surface& mesh, const Surface& model,
                                           const std::vector<SurfacePoint>& model_samples,
                                           const std::vector<bool>& model_seen);

}  // namespace disflow::apps
