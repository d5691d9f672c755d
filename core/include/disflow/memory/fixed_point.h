// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace disflow {

/// Largest magnitude of a number in 16-bit fixed point, in steps.
inline constexpr float kMostSteps = 32767.0F;

/// The nearest number of steps; what lies beyond the range becomes its end, NaN becomes the lower
/// end. Rounds alike on every processor and in every rounding mode that it may be in.
[[nodiscard]] inline std::int16_t RoundToSteps(float steps) noexcept {
  const float above = steps > -kMostSteps ? steps : -kMostSteps;  // NaN too
  const float bounded = above < kMostSteps ? above : kMostSteps;
  return static_cast<std::int16_t>(bounded < 0.0F ? bounded - 0.5F : bounded + 0.5F);
}

}  // namespace disflow
