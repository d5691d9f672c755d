// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/status.h"

namespace disflow::hal::mavlink {

/// @return The CRC_EXTRA of a message by its number, without which its checksum can be neither
/// made nor verified; kUnsupported for a message that is not in KnownMessages.
[[nodiscard]] Expected<std::uint8_t> CrcExtraOf(std::uint32_t message_id) noexcept;

}  // namespace disflow::hal::mavlink
