// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/status.h"

namespace disflow::apps {

/// @return The status as one lower-case word for machines, e.g. "empty_mask"; static storage.
[[nodiscard]] const char* StatusToken(Status status) noexcept;

}  // namespace disflow::apps
