// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "disflow/types.h"

namespace disflow::host {

/// Decimal seconds to nanoseconds without a detour through double.
/// @return false if the text is no number of seconds from 0 on; `stamp_ns` is meaningless then.
[[nodiscard]] bool ParseStamp(std::string_view text, StampNs& stamp_ns);

}  // namespace disflow::host
