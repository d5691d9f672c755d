// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace disflow::hal::mavlink {

/// CRC-16/MCRF4XX, the checksum of MAVLink frames and message definitions: polynomial 0x1021
/// reflected, start value 0xFFFF, no final inversion.
class Crc {
 public:
  constexpr void Add(std::uint8_t byte) noexcept {
    value_ = static_cast<std::uint16_t>(value_ ^ byte);
    for (int bit = 0; bit < 8; ++bit) {
      const bool carry = (value_ & 1U) != 0;
      value_ = static_cast<std::uint16_t>(value_ >> 1U);
      if (carry) value_ = static_cast<std::uint16_t>(value_ ^ kReflectedPolynomial);
    }
  }
  constexpr void Add(std::span<const std::byte> bytes) noexcept {
    for (const std::byte byte : bytes) Add(std::to_integer<std::uint8_t>(byte));
  }
  constexpr void Add(std::string_view text) noexcept {
    for (const char c : text) Add(static_cast<std::uint8_t>(c));
  }

  [[nodiscard]] constexpr std::uint16_t value() const noexcept { return value_; }

 private:
  static constexpr std::uint16_t kReflectedPolynomial = 0x8408;
  std::uint16_t value_ = 0xFFFF;
};

}  // namespace disflow::hal::mavlink
