// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace disflow::apps {

/// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

/// A map whose lightness rises evenly, from dark blue through green to yellow: it reads the same in
/// grey and for colour-blind people.
/// @param share 0 to 1; others and NaN are clamped.
[[nodiscard]] Colour MapColour(float share) noexcept;

}  // namespace disflow::apps
