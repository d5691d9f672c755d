// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "disflow/hal/fault.h"
#include "disflow/host/simulation_options.h"
#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// The mesh that the options ask for: procedural, or read from an OBJ file (in metres) and moved so
/// that the centre of its bounding box is its origin.
/// @param mesh Unchanged unless the result is ok.
[[nodiscard]] hal::Fault LoadSimulatedObject(const SimulationOptions& options, TriangleMesh& mesh);
/// The same of all objects.
[[nodiscard]] hal::Fault LoadSimulatedObjects(const SimulationOptions& options,
                                              std::vector<TriangleMesh>& meshes);

}  // namespace disflow::host
