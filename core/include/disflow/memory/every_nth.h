// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace disflow {

/// An even part of a sequence, at most `count` of its elements, in order. A view. In other frames
/// it is moved by the golden ratio of its spacing, so that every element of a sequence that does
/// not change gets its turn: in 2.6 times the fewest frames as long as a hundredth and more of it
/// is taken, in 65536 frames always.
template <class Sequence>
class EveryNth {
 public:
  EveryNth(const Sequence& sequence, int count, std::uint32_t frame = 0) noexcept
      : sequence_(sequence),
        count_(count < sequence.size() ? count : sequence.size()),
        phase_((frame * kGoldenRatio) & (kSpacing - 1U)) {}
  [[nodiscard]] int size() const noexcept { return count_; }
  [[nodiscard]] const auto& operator[](int i) const noexcept {
    const std::int64_t place = std::int64_t{i} * kSpacing + phase_;
    return sequence_[static_cast<int>(place * sequence_.size() / count_ / kSpacing)];
  }

 private:
  static constexpr std::uint32_t kSpacing = 1U << 16U;
  static constexpr std::uint32_t kGoldenRatio = 40503;  // of kSpacing

  const Sequence& sequence_;
  int count_;
  std::uint32_t phase_;
};

}  // namespace disflow
