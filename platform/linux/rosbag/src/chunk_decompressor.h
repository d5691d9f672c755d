// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::posix {

/// Unpacks what MCAP and bags pack: `lz4` (its frame format), `zstd`, `bz2`,
/// or nothing.
/// @param unpacked Is made as long as it has to become; the caller has bounded that.
/// @return kUnsupported for another packing; kCorrupt if it is damaged or of another length.
[[nodiscard]] hal::Fault Decompress(std::string_view compression,
                                    std::span<const std::uint8_t> packed,
                                    std::vector<std::uint8_t>& unpacked);

/// Unpacks a message that rosbag2 has packed by itself, if it has.
/// @param message Is pointed to `unpacked` then.
[[nodiscard]] hal::Fault DecompressMessage(std::vector<std::uint8_t>& unpacked,
                                           std::span<std::uint8_t>& message);

}  // namespace disflow::posix
