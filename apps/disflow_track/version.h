// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace disflow::apps {

/// What --version prints: name, version and compiler, then a line "with:" that lists what this
/// program was built with, one word each.
[[nodiscard]] std::string VersionText();

}  // namespace disflow::apps
