// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "named_path.h"

namespace disflow::apps {

/// Files and folders from which that is read what an address stands for: a sensor's, a link's, or
/// the plain name of a recording. In the folder of a sequence these are the files and folders of
/// its layout; results may lie beside them.
/// @param option That the address belongs to.
[[nodiscard]] std::vector<NamedPath> InputPaths(const std::string& option,
                                                const std::string& address);

}  // namespace disflow::apps
