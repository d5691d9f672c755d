// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sequence_index.h"

namespace disflow::host {

/// A mask's values are the objects' numbers, from 1 on.
inline constexpr std::size_t kMostLabels = 255;

[[nodiscard]] hal::Fault TooManyObjects(std::size_t count);

/// The names that `object=` joins by +.
[[nodiscard]] std::vector<std::string> SplitNames(const std::string& names);

/// Finds masks/SET/OBJECT_I.png of every frame, as the options say.
[[nodiscard]] hal::Fault FindMasks(const ReplayOptions& options, SequenceIndex& index);

}  // namespace disflow::host
