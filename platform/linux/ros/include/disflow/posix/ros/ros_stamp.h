// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/hal/fault.h"
#include "disflow/types.h"

namespace disflow::posix {

/// The capture time that a message's header says; it is never made up.
/// @return kCorrupt for none and for what is no time.
[[nodiscard]] hal::Fault ReadRosStamp(std::int32_t sec, std::uint32_t nanosec,
                                      StampNs& stamp_ns) noexcept;

}  // namespace disflow::posix
