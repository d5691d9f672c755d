// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace disflow::fuzz {

/// Numbers and texts from the front of the fuzzer's bytes; zeros when they are used up.
class FuzzedNumbers {
 public:
  FuzzedNumbers(const std::uint8_t* data, std::size_t size) : rest_(data, data + size) {}

  template <class T>
  T Take() {
    T value{};
    const std::size_t size = std::min(sizeof(T), rest_.size());
    if (size > 0) std::memcpy(&value, rest_.data(), size);
    Skip(size);
    return value;
  }
  /// Fewer if there are no more.
  std::vector<std::uint8_t> TakeBytes(std::size_t size) {
    size = std::min(size, rest_.size());
    std::vector<std::uint8_t> bytes(rest_.begin(),
                                    rest_.begin() + static_cast<std::ptrdiff_t>(size));
    Skip(size);
    return bytes;
  }
  std::string TakeText() {
    const std::vector<std::uint8_t> bytes = TakeBytes(Take<std::uint8_t>());
    return {bytes.begin(), bytes.end()};
  }
  [[nodiscard]] bool empty() const { return rest_.empty(); }
  std::vector<std::uint8_t>& rest() { return rest_; }

 private:
  void Skip(std::size_t size) {
    rest_.erase(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(size));
  }

  std::vector<std::uint8_t> rest_;
};

}  // namespace disflow::fuzz
