// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "disflow/hal/fault.h"
#include "disflow/host/triangle_mesh.h"

namespace disflow::host {

/// Reads the triangles of a Wavefront OBJ file, metres. Polygons are split; materials are ignored.
/// @param mesh Unchanged unless the result is ok.
/// @return kNotFound, kCorrupt (no triangles, bad indices, not finite), naming the file.
[[nodiscard]] hal::Fault ReadObj(const std::filesystem::path& file, TriangleMesh& mesh);

[[nodiscard]] hal::Fault WriteObj(const std::filesystem::path& file, const TriangleMesh& mesh);

}  // namespace disflow::host
