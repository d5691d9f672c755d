// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>

namespace disflow {

/// A float from 0 to 2^20 in two bytes: no sign, 6 bits of exponent, 10 bits of mantissa. Relative
/// error at most 2^-11 above 2^-43 (a standard deviation of 0.3 micrometres); below, down to 0, the
/// error is less than 2^-44. Larger numbers become the largest one; negative ones and NaN become 0.
class PackedVariance {
 public:
  static constexpr float kLargest = 1048064.0F;  ///< (2 - 2^-10) 2^19

  PackedVariance() = default;
  explicit PackedVariance(float value) noexcept : code_(Encode(value)) {}

  [[nodiscard]] float value() const noexcept {
    const auto code = static_cast<std::uint32_t>(code_);
    return code == 0U ? 0.0F : std::bit_cast<float>((code + kBias) << kDroppedBits);
  }

 private:
  static constexpr unsigned kDroppedBits = 13;  ///< Of a float's mantissa.
  /// Difference of the exponents' offsets. The smallest exponent is that of 2^-44.
  static constexpr std::uint32_t kBias = (127U - 44U) << 10U;

  [[nodiscard]] static std::uint16_t Encode(float value) noexcept {
    if (!(value > 0.0F)) return 0;  // NaN too
    constexpr std::uint32_t kHalf = 1U << (kDroppedBits - 1U);
    const std::uint32_t rounded = (std::bit_cast<std::uint32_t>(value) + kHalf) >> kDroppedBits;
    if (rounded <= kBias) return 0;
    const std::uint32_t code = rounded - kBias;
    return code < 0xFFFFU ? static_cast<std::uint16_t>(code) : std::uint16_t{0xFFFF};
  }

  std::uint16_t code_;
};

}  // namespace disflow
