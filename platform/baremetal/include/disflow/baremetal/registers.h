// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace disflow::baremetal {

/// A 32-bit device register at a fixed address.
[[nodiscard]] inline volatile std::uint32_t& Register(std::uintptr_t address) noexcept {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}

}  // namespace disflow::baremetal
