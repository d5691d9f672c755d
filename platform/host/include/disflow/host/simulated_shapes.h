// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/host/simulation_options.h"
#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// The mesh of a procedural object, as it is drawn. @pre object is not kObjFile.
[[nodiscard]] TriangleMesh MakeObjectMesh(ObjectKind object);

/// The same with the edges and faces that the options ask for.
[[nodiscard]] TriangleMesh MakeObjectMesh(ObjectKind object, const SimulationOptions& options);

/// Whether edge_mm, bulge_mm mean anything for an object.
[[nodiscard]] bool HasRoundedEdges(ObjectKind object);
[[nodiscard]] bool HasFlatFaces(ObjectKind object);

}  // namespace disflow::host
