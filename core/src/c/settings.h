// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "disflow.h"
#include "disflow/config.h"

namespace disflow::c {

/// Changes the settings that are named.
/// @param refused Null, or receives the one that was refused.
/// @return kNotFound or kInvalidConfig at the first that cannot be.
[[nodiscard]] Status Apply(const disflow_setting* settings, std::size_t count, Config& config,
                           disflow_setting_info* refused) noexcept;

}  // namespace disflow::c
