// SPDX-License-Identifier: BSD-3-Clause
#include "colour_map.h"

#include <algorithm>
#include <cmath>

namespace disflow::apps {
namespace {

constexpr std::array<std::array<float, 3>, 6> kStops = {{{68.0F, 1.0F, 84.0F},
                                                         {65.0F, 68.0F, 135.0F},
                                                         {42.0F, 120.0F, 142.0F},
                                                         {34.0F, 168.0F, 132.0F},
                                                         {122.0F, 209.0F, 81.0F},
                                                         {253.0F, 231.0F, 37.0F}}};

}  // namespace

Colour MapColour(float share) noexcept {
  const float clamped = share > 0.0F ? std::min(share, 1.0F) : 0.0F;  // NaN becomes 0
  const float position = clamped * static_cast<float>(kStops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
  const float weight = position - static_cast<float>(below);
  Colour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const float value = kStops[below][i] + weight * (kStops[below + 1][i] - kStops[below][i]);
    colour[i] = static_cast<std::uint8_t>(std::lround(value));
  }
  return colour;
}

}  // namespace disflow::apps
