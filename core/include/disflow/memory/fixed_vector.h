// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cassert>
#include <type_traits>

namespace disflow {

/// Sequence with inline storage for at most kCapacity elements. Never allocates; a push beyond
/// capacity is refused and says so.
template <class T, int kCapacityParam>
class FixedVector {
  static_assert(std::is_trivially_destructible_v<T>, "elements are overwritten, never destroyed");

 public:
  static constexpr int kCapacity = kCapacityParam;

  [[nodiscard]] int size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] bool full() const noexcept { return size_ == kCapacity; }
  void clear() noexcept { size_ = 0; }

  /// @return false when full; the vector is then unchanged.
  [[nodiscard]] bool push_back(const T& value) noexcept {
    if (full()) return false;
    items_[static_cast<std::size_t>(size_++)] = value;
    return true;
  }
  /// Removes element i by moving the last one into its place. Order is not kept.
  void swap_remove(int i) noexcept {
    (*this)[i] = items_[static_cast<std::size_t>(size_ - 1)];
    --size_;
  }
  /// Keeps the first `count` elements.
  void truncate(int count) noexcept {
    assert(count >= 0 && count <= size_);
    size_ = count;
  }

  [[nodiscard]] T& operator[](int i) noexcept {
    assert(i >= 0 && i < size_);
    return items_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const T& operator[](int i) const noexcept {
    assert(i >= 0 && i < size_);
    return items_[static_cast<std::size_t>(i)];
  }
  [[nodiscard]] T& back() noexcept { return (*this)[size_ - 1]; }

  [[nodiscard]] T* begin() noexcept { return items_.data(); }
  [[nodiscard]] T* end() noexcept { return items_.data() + size_; }
  [[nodiscard]] const T* begin() const noexcept { return items_.data(); }
  [[nodiscard]] const T* end() const noexcept { return items_.data() + size_; }

 private:
  std::array<T, static_cast<std::size_t>(kCapacity)> items_;
  int size_ = 0;
};

}  // namespace disflow
