// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace disflow {

/// An even part of a list that is another one in each frame: it moves by the golden ratio of its
/// spacing, so that every element of a list that does not change gets its turn: in 2.6 times the
/// fewest frames as long as a hundredth and more of it is taken, in 65536 frames always.
class MovingSubset {
 public:
  /// @param size Elements of the list.
  /// @param wanted How many to take, up to size.
  MovingSubset(int size, int wanted, std::uint32_t frame) noexcept
      : size_(size), wanted_(wanted), phase_((frame * kGoldenRatio) & (kWhole - 1U)) {}

  /// @param i Up to but not including `wanted`.
  /// @return Index into the list, increasing with i.
  [[nodiscard]] int At(int i) const noexcept {
    return static_cast<int>((std::int64_t{i} * kWhole + phase_) * size_ / wanted_ / kWhole);
  }

 private:
  static constexpr std::uint32_t kWhole = 1U << 16U;
  static constexpr std::uint32_t kGoldenRatio = 40503;  // of kWhole

  int size_;
  int wanted_;
  std::int64_t phase_;
};

}  // namespace disflow
