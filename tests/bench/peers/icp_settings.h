// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow::bench {

/// What ICP minimises between corresponding points.
enum class IcpKind {
  kGeneralised,   ///< Plane to plane: Segal et al., "Generalized-ICP", RSS 2009.
  kPointToPlane,  ///< Distances along the model's normals.
};

struct IcpSettings {
  IcpKind kind = IcpKind::kGeneralised;
  float voxel_m = 0.003F;         ///< Of frames and model alike.
  float max_distance_m = 0.010F;  ///< Of corresponding points.
  int neighbours = 20;            ///< That a normal is made from.
  /// Of the discs that generalised ICP takes points for: variance across over variance along. PCL's
  /// own is 0.001.
  double flatness = 0.001;
};

}  // namespace disflow::bench
