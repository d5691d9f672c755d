// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <limits>
#include <type_traits>

namespace disflow {

/// Counts up without ever wrapping to a small number.
template <std::unsigned_integral Counter>
constexpr void AddSaturating(Counter& counter, std::type_identity_t<Counter> more = 1) noexcept {
  constexpr Counter kMax = std::numeric_limits<Counter>::max();
  counter = more > kMax - counter ? kMax : static_cast<Counter>(counter + more);
}

}  // namespace disflow
