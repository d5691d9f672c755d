// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

/// @file
/// Numbers as all formats of this project hold them: the low byte first, on any processor and at
/// any address.

namespace disflow::hal {

/// Unsigned integer that holds the bits of T, a number of 1, 2, 4 or 8 bytes.
template <class T>
using BitsOf = std::conditional_t<
    sizeof(T) == 1, std::uint8_t,
    std::conditional_t<sizeof(T) == 2, std::uint16_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

/// @param bytes The number's first byte and what follows; bytes that are missing count as zeros.
template <class T>
[[nodiscard]] constexpr T LoadLittleEndian(std::span<const std::byte> bytes) noexcept {
  BitsOf<T> bits = 0;
  for (std::size_t i = 0; i < std::min(sizeof(T), bytes.size()); ++i) {
    const auto byte = static_cast<BitsOf<T>>(std::to_integer<std::uint8_t>(bytes[i]));
    bits = static_cast<BitsOf<T>>(bits | static_cast<BitsOf<T>>(byte << (8 * i)));
  }
  return std::bit_cast<T>(bits);
}

/// @param out At least sizeof(T) bytes.
template <class T>
constexpr void StoreLittleEndian(T value, std::span<std::byte> out) noexcept {
  const auto bits = std::bit_cast<BitsOf<T>>(value);
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    out[i] = static_cast<std::byte>((bits >> (8 * i)) & 0xFFU);
  }
}

}  // namespace disflow::hal
