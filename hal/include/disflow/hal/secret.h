// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

/// @file
/// Care for bytes that nobody else may learn.

namespace disflow::hal {

/// Overwrites bytes with zeros, also where the compiler sees that nobody reads them again.
inline void Wipe(std::span<std::byte> bytes) noexcept {
  for (volatile std::byte& byte : bytes) byte = std::byte{0};
}

/// Compares in a time that does not tell where the difference is.
/// @return false for different sizes.
[[nodiscard]] inline bool EqualInConstantTime(std::span<const std::byte> a,
                                              std::span<const std::byte> b) noexcept {
  if (a.size() != b.size()) return false;
  // Volatile, or the compiler might leave the loop as soon as the result is known.
  volatile unsigned char difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference =
        static_cast<unsigned char>(difference | std::to_integer<unsigned char>(a[i] ^ b[i]));
  }
  return difference == 0;
}

}  // namespace disflow::hal
