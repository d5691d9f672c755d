// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// What is needed of a Wavefront OBJ file, for a loader that trusts it: the lines of vertices,
/// texture coordinates, normals and faces. All others are left out, among them those with which a
/// few bytes ask for gigabytes.
/// @param text Unchanged unless the result is ok.
/// @return kNotFound, or kCorrupt if the file is absurdly large or a face has a hundred corners and
/// more, which a loader would cut up in a time that grows with their square; naming the file.
[[nodiscard]] hal::Fault ReadObjText(const std::filesystem::path& file, std::string& text);

}  // namespace disflow::host
