// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "disflow/host/rigid_state.h"

namespace disflow::host {

/// Triangles in an object's frame, metres; counter-clockwise when seen from outside.
struct TriangleMesh {
  using Triangle = std::array<std::uint32_t, 3>;
  std::vector<Vec3d> vertices;
  std::vector<Triangle> triangles;
};

/// Radius of the smallest sphere about the origin that holds all vertices.
[[nodiscard]] double BoundingRadius(const TriangleMesh& mesh);

/// Moves the mesh so that the centre of its bounding box is the origin.
void MoveCentreToOrigin(TriangleMesh& mesh);

/// Adds another mesh, moved.
void Append(const TriangleMesh& part, const Vec3d& at_m, TriangleMesh& mesh);

/// Points spread evenly over the surface (uniform by area), the same ones on every call.
[[nodiscard]] std::vector<Vec3d> SampleSurface(const TriangleMesh& mesh, int count);

}  // namespace disflow::host
