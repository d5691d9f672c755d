// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "disflow/hal/mavlink/frame_decoder.h"
#include "disflow/hal/mavlink/time_sync.h"

/// @file
/// What is said to people of a link. All but ClockWords() are empty if there is nothing to say.

namespace disflow::apps {

/// What was not authentic, each kind if there was any.
[[nodiscard]] std::string NotAuthentic(const hal::mavlink::DecoderCounters& counters);
[[nodiscard]] std::string LeftOut(std::uint64_t bytes);
[[nodiscard]] std::string NotSigned(std::uint32_t messages);
/// @param restarts Times that the autopilot's clock was another one.
[[nodiscard]] std::string ClockWords(const Expected<hal::mavlink::ClockOffset>& offset,
                                     std::uint32_t restarts);

}  // namespace disflow::apps
