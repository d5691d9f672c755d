// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "disflow/hal/depth_stream/packet.h"

namespace disflow::baremetal {

/// Memory for one image that comes over a line; its size is the firmware's choice.
[[nodiscard]] std::span<std::uint16_t> StreamImage() noexcept;
/// Time budgets in force; zero until the sender of the depth images sets some.
[[nodiscard]] hal::depth_stream::TimeBudgets& Budgets() noexcept;

}  // namespace disflow::baremetal
