// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace disflow::posix {

/// Hands the newest value from one thread to another: room for one, and a newer one takes its
/// place. Three buffers, one with either side and one between them, so that neither side ever waits
/// for the other, however long it works on its own. Values are written and read in place; nothing
/// is allocated or copied here.
template <class T>
class TripleBuffer {
 public:
  TripleBuffer() = default;
  TripleBuffer(const TripleBuffer&) = delete;
  TripleBuffer& operator=(const TripleBuffer&) = delete;

  /// Does something with each of the buffers, e.g. allocates what they will need. Before the
  /// threads start.
  template <class Prepare>
  void ForEach(const Prepare& prepare) {
    for (T& value : values_) prepare(value);
  }

  // By the writer.
  /// The writer's own buffer, with some older value in it.
  [[nodiscard]] T& back() noexcept { return values_[back_]; }
  /// Makes back() the newest value, and gives the writer another buffer.
  /// @return true if the value published before was never taken; it is what back() holds now.
  bool Publish() noexcept {
    const std::uint8_t before =
        between_.exchange(static_cast<std::uint8_t>(back_ | kFresh), std::memory_order_acq_rel);
    back_ = before & kIndex;
    return (before & kFresh) != 0;
  }

  // By the reader.
  /// The reader's own buffer: the value taken last.
  [[nodiscard]] T& front() noexcept { return values_[front_]; }
  /// Makes the newest value front(), and gives back what was there.
  /// @return false if nothing was published since the last call: front() is as it was.
  bool Take() noexcept {
    if (!HasNews()) return false;
    front_ = between_.exchange(front_, std::memory_order_acq_rel) & kIndex;
    return true;
  }

  /// By either side.
  /// @return true if a value waits to be taken.
  [[nodiscard]] bool HasNews() const noexcept {
    return (between_.load(std::memory_order_acquire) & kFresh) != 0;
  }

 private:
  static constexpr std::uint8_t kIndex = 3;
  static constexpr std::uint8_t kFresh = 4;  ///< Beside the index: not taken yet.

  std::array<T, 3> values_{};
  std::uint8_t back_ = 0;
  std::uint8_t front_ = 1;
  std::atomic<std::uint8_t> between_ = 2;
};

}  // namespace disflow::posix
