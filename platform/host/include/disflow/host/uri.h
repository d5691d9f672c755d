// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// A sensor's address taken apart: `scheme:path?key=value&key=value`. Nothing is escaped; a path
/// cannot contain '?'.
struct Uri {
  std::string scheme;
  std::string path;
  std::vector<std::pair<std::string, std::string>> query;  ///< In the order given, keys unique.
};

/// @param uri Unchanged unless the result is ok.
/// @return kInvalidUri with the part that is wrong and what it should look like.
[[nodiscard]] hal::Fault ParseUri(std::string_view text, Uri& uri);

}  // namespace disflow::host
