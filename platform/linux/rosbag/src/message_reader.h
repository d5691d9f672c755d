// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace disflow::posix {

/// How a message was put into bytes.
enum class Serialization : std::uint8_t {
  kCdr,   ///< ROS 2: OMG's CDR, plain, of either byte order.
  kRos1,  ///< ROS 1: little endian, nothing aligned.
};

/// Takes a message of others apart, field by field. What is not there reads as nothing, and ok()
/// says so from then on.
class MessageReader {
 public:
  MessageReader(Serialization serialization, std::span<std::uint8_t> message) noexcept;

  template <class T>
  [[nodiscard]] T Take() noexcept {
    Align(sizeof(T));
    const std::span<std::uint8_t> bytes = TakeBytes(sizeof(T));
    if (!ok_) return T{};
    std::array<std::uint8_t, sizeof(T)> ordered{};
    for (std::size_t i = 0; i < sizeof(T); ++i) ordered[i] = bytes[swap_ ? sizeof(T) - 1 - i : i];
    return std::bit_cast<T>(ordered);
  }
  template <class T, std::size_t kCount>
  void TakeAll(std::array<T, kCount>& values) noexcept {
    for (T& value : values) value = Take<T>();
  }
  [[nodiscard]] std::string_view TakeText() noexcept;
  /// A sequence of bytes, which are lent.
  [[nodiscard]] std::span<std::uint8_t> TakeByteSequence() noexcept;
  [[nodiscard]] bool is_ros1() const noexcept { return !aligned_; }
  [[nodiscard]] bool ok() const noexcept { return ok_; }

 private:
  void Align(std::size_t size) noexcept;
  [[nodiscard]] std::span<std::uint8_t> TakeBytes(std::size_t count) noexcept;

  std::span<std::uint8_t> body_;
  std::size_t at_ = 0;
  bool aligned_ = true;
  bool swap_ = false;
  bool ok_ = true;
};

}  // namespace disflow::posix
