// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/host/triangle_mesh.h"

/// @file
/// What makes drawn things more like things: bulged faces, uneven surface.

namespace disflow::host {

/// Splits triangles until no edge is longer. What was closed stays closed.
void Refine(TriangleMesh& mesh, double longest_edge_m);

/// Bulges the faces of a box about the origin outwards: most in the middle, not at all from where
/// its rounded edges begin.
/// @param edge_radius_m Of the box.
void BulgeFaces(TriangleMesh& mesh, double edge_radius_m, double bulge_m);

/// Warps space, and the mesh with it, smoothly over 12 to 60 mm, as cardboard, cast plastic and
/// the scans of both are: along any direction by this standard deviation, and thin walls keep their
/// thickness. The same for every mesh.
void Warp(TriangleMesh& mesh, double std_m);

}  // namespace disflow::host
