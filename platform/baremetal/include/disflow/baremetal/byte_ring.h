// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace disflow::baremetal {

/// Queue of bytes between an interrupt and the program: one end each.
/// @tparam kCapacity A power of two.
template <std::uint32_t kCapacity>
class ByteRing {
  static_assert((kCapacity & (kCapacity - 1)) == 0);

 public:
  /// @return false if the ring is full; the byte is not taken then.
  [[nodiscard]] bool Push(std::byte byte) noexcept {
    const std::uint32_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) == kCapacity) return false;
    bytes_[end % kCapacity] = byte;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }
  /// @return false if the ring is empty.
  [[nodiscard]] bool Pop(std::byte& byte) noexcept {
    const std::uint32_t begin = begin_.load(std::memory_order_relaxed);
    if (begin == end_.load(std::memory_order_acquire)) return false;
    byte = bytes_[begin % kCapacity];
    begin_.store(begin + 1, std::memory_order_release);
    return true;
  }
  [[nodiscard]] std::uint32_t free() const noexcept {
    return kCapacity -
           (end_.load(std::memory_order_acquire) - begin_.load(std::memory_order_acquire));
  }

 private:
  // They count on without wrapping at the capacity, so that a full ring differs from an empty one.
  std::atomic<std::uint32_t> begin_{0};
  std::atomic<std::uint32_t> end_{0};
  std::array<std::byte, kCapacity> bytes_{};
};

}  // namespace disflow::baremetal
