// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/host/triangle_mesh.h"

/// @file
/// Household objects with the sizes of well-known test objects. All have the centre of their
/// bounding box as origin and +z up; facets deviate from the smooth shape by less than 0.05 mm.

namespace disflow::host {

/// Cardboard box 0.072 x 0.164 x 0.213 m with sharp edges, as YCB object 003.
[[nodiscard]] TriangleMesh MakeCrackerBox();
/// Oval squeeze bottle 0.095 x 0.058 x 0.191 m with shoulders, neck and nozzle, as YCB object 006;
/// its back is rounder than its front, so that no turn maps it onto itself.
[[nodiscard]] TriangleMesh MakeMustardBottle();
/// Can of 0.102 m diameter and 0.14 m height with raised rims, beads and one side seam, as YCB 002.
[[nodiscard]] TriangleMesh MakeCan();
/// Plain torus of 0.12 m outer diameter and 0.04 m thickness.
[[nodiscard]] TriangleMesh MakeDoughnut();
/// Box 0.16 x 0.07 x 0.2 m whose edges and corners are rounded by 4 mm, as of scanned boxes.
[[nodiscard]] TriangleMesh MakeRoundedBox();
/// Flat box 0.09 x 0.075 x 0.03 m, rounded by 2 mm.
[[nodiscard]] TriangleMesh MakeFlatBox();
/// Mug of 84 mm diameter and 95 mm height, hollow, with a handle along +x.
[[nodiscard]] TriangleMesh MakeMug();
/// Capsule about the z axis, from z = 0 (the tip) to z = -length.
[[nodiscard]] TriangleMesh MakeCapsule(double radius_m, double length_m);

}  // namespace disflow::host
