// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace disflow::hal::depth_stream {

/// CRC-32 as in Ethernet and zlib: polynomial 0x04C11DB7 reflected. Half a byte at a time, so that
/// its table takes 64 bytes.
[[nodiscard]] constexpr std::uint32_t Crc32(std::span<const std::byte> bytes) noexcept {
  constexpr std::uint32_t kReflectedPolynomial = 0xEDB88320;
  constexpr auto kTable = [] {
    std::array<std::uint32_t, 16> table{};
    for (std::uint32_t i = 0; i < table.size(); ++i) {
      std::uint32_t value = i;
      for (int bit = 0; bit < 4; ++bit) {
        value = (value >> 1U) ^ ((value & 1U) != 0 ? kReflectedPolynomial : 0U);
      }
      table[i] = value;
    }
    return table;
  }();
  std::uint32_t crc = 0xFFFFFFFF;
  for (const std::byte byte : bytes) {
    crc ^= std::to_integer<std::uint32_t>(byte);
    crc = (crc >> 4U) ^ kTable[crc & 0xFU];
    crc = (crc >> 4U) ^ kTable[crc & 0xFU];
  }
  return ~crc;
}

}  // namespace disflow::hal::depth_stream
