// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "surface.h"

namespace disflow::apps {

/// Reads a PLY file, ascii or binary little endian: vertices with x y z and, if given, nx ny nz;
/// faces with any number of corners, split into triangles. Other elements and properties are
/// skipped.
/// @throws InputError naming file and reason: no PLY, other format, truncated, index out of range,
/// not finite, no vertices.
[[nodiscard]] Surface LoadPly(const std::filesystem::path& file);

}  // namespace disflow::apps
