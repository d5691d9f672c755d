// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <random>

namespace disflow::host {

/// Random numbers that are the same with every standard library (unlike the distributions of
/// the standard header).
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : engine_(seed) {}
  /// An independent stream per (seed, index).
  RandomNumbers(std::uint64_t seed, std::uint64_t index)
      // Any odd constant with well-mixed bits keeps neighbouring indices and seeds apart.
      : engine_(seed * 0x9E3779B97F4A7C15U ^ (index + 1) * 0xD1B54A32D192ED03U) {}

  [[nodiscard]] std::uint64_t Bits() { return engine_(); }
  /// In [0, 1).
  [[nodiscard]] double Uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
  [[nodiscard]] double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

 private:
  std::mt19937_64 engine_;
};

/// Hands out the bits of one draw after another; for many small random numbers.
class BitSource {
 public:
  explicit BitSource(RandomNumbers& random) : random_(random) {}

  /// @param count 1 to 32.
  [[nodiscard]] std::size_t Take(unsigned count) {
    if (left_ < count) {
      bits_ = random_.Bits();
      left_ = 64;
    }
    const auto value = static_cast<std::size_t>(bits_ & ((std::uint64_t{1} << count) - 1));
    bits_ >>= count;
    left_ -= count;
    return value;
  }

 private:
  RandomNumbers& random_;
  std::uint64_t bits_ = 0;
  unsigned left_ = 0;
};

}  // namespace disflow::host
