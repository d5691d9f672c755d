// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "disflow/hal/fault.h"
#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// Reads a Wavefront OBJ mesh, metres; polygons are cut into triangles.
/// @return kNotFound or kCorrupt with the file's name and the reason.
[[nodiscard]] hal::Fault ReadObj(const std::string& file, TriangleMesh& mesh);

/// Writes vertices and triangles.
[[nodiscard]] hal::Fault WriteObj(const std::string& file, const TriangleMesh& mesh);

}  // namespace disflow::host
