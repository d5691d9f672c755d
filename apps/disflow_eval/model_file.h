// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "surface.h"

namespace disflow::apps {

/// Reads an object's model: Wavefront OBJ, or points as text (.xyz: "x y z" or "x y z nx ny nz" per
/// line, # starts a comment). Metres, true object frame.
/// @throws InputError naming file and reason.
[[nodiscard]] Surface LoadModel(const std::filesystem::path& file);

}  // namespace disflow::apps
