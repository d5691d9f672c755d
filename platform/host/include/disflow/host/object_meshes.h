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
/// Box whose edges and corners are rounded, by less than half of any side.
[[nodiscard]] TriangleMesh MakeRoundedCuboid(const Vec3d& half_m, double radius_m);
inline constexpr double kRoundedBoxEdge_m = 0.004;
inline constexpr double kFlatBoxEdge_m = 0.002;
/// Box 0.16 x 0.07 x 0.2 m whose edges and corners are rounded, as of scanned boxes.
[[nodiscard]] TriangleMesh MakeRoundedBox(double edge_radius_m = kRoundedBoxEdge_m);
/// Flat box 0.09 x 0.075 x 0.03 m, rounded.
[[nodiscard]] TriangleMesh MakeFlatBox(double edge_radius_m = kFlatBoxEdge_m);
/// Mug of 84 mm diameter and 95 mm height, hollow, with a handle along +x.
[[nodiscard]] TriangleMesh MakeMug();
/// Bowl of 0.148 m diameter and 60 mm height with a wall of 3 mm, open at the top.
[[nodiscard]] TriangleMesh MakeBowl();
/// Pipe of 54 mm diameter and 0.16 m length with a wall of 3 mm, open at both ends.
[[nodiscard]] TriangleMesh MakeTube();
/// Something between box and ellipsoid, 0.1 x 0.07 x 0.14 m: no flat face, no edge.
[[nodiscard]] TriangleMesh MakeSuperellipsoid();
/// Screwdriver of 0.215 m: a handle with six flutes, a shaft of 7 mm, a flat blade.
[[nodiscard]] TriangleMesh MakeScrewdriver();
/// L of sheet metal: legs of 90 and 65 mm, 6 mm thick, 40 mm wide.
[[nodiscard]] TriangleMesh MakeBracket();
/// Bottle of 0.092 x 0.058 x 0.2 m with a spray head, nozzle and trigger along +x.
[[nodiscard]] TriangleMesh MakeSprayBottle();
/// Capsule about the z axis, from z = 0 (the tip) to z = -length.
[[nodiscard]] TriangleMesh MakeCapsule(double radius_m, double length_m);

}  // namespace disflow::host
