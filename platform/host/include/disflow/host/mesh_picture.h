// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// Red, green, blue.
using Rgb = std::array<std::uint8_t, 3>;

/// From where a mesh is looked at. At zero angles the mesh's axes are the picture's: x right,
/// y down, z away from the viewer, as an object frame is in the first camera image.
struct MeshView {
  double azimuth_rad = 0.0;    ///< Turns the mesh about the vertical.
  double elevation_rad = 0.0;  ///< Positive: seen from above.
  int width_px = 640;
  int height_px = 480;
};

/// A shaded picture of a mesh that fills the image, on white. Surfaces seen from behind are grey.
/// @param vertex_colors One per vertex of the mesh.
/// @return width x height x 3 bytes; for EncodeRgbPng().
[[nodiscard]] std::vector<std::uint8_t> RenderMesh(const TriangleMesh& mesh,
                                                   const std::vector<Rgb>& vertex_colors,
                                                   const MeshView& view);

}  // namespace disflow::host
