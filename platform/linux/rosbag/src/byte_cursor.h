// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "disflow/hal/little_endian.h"

namespace disflow::posix {

/// Takes little-endian values from the front of bytes of others. What is not there reads as
/// nothing, and ok() says so from then on.
class ByteCursor {
 public:
  explicit ByteCursor(std::span<std::uint8_t> bytes) noexcept : rest_(bytes) {}

  template <class T>
  [[nodiscard]] T Take() noexcept {
    const std::span<std::uint8_t> bytes = TakeBytes(sizeof(T));
    return ok_ ? hal::LoadLittleEndian<T>(std::as_bytes(bytes)) : T{};
  }
  [[nodiscard]] std::span<std::uint8_t> TakeBytes(std::uint64_t count) noexcept {
    ok_ = ok_ && count <= rest_.size();
    if (!ok_) return {};
    const auto taken = rest_.first(static_cast<std::size_t>(count));
    rest_ = rest_.subspan(taken.size());
    return taken;
  }
  /// A text with its length, 32 bits, ahead.
  [[nodiscard]] std::string_view TakeText() noexcept {
    const auto bytes = TakeBytes(Take<std::uint32_t>());
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

  [[nodiscard]] std::span<std::uint8_t> rest() const noexcept { return rest_; }
  [[nodiscard]] bool ok() const noexcept { return ok_; }

 private:
  std::span<std::uint8_t> rest_;
  bool ok_ = true;
};

}  // namespace disflow::posix
