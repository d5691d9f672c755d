// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace disflow::posix {

/// Appends little-endian values to bytes.
class ByteSink {
 public:
  explicit ByteSink(std::vector<std::uint8_t>& bytes) noexcept : bytes_(bytes) {}

  template <class T>
  ByteSink& Put(T value) {
    return PutBytes({reinterpret_cast<const std::uint8_t*>(&value), sizeof(T)});
  }
  ByteSink& PutBytes(std::span<const std::uint8_t> bytes);
  /// With its length ahead.
  ByteSink& PutText(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    return PutBytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  /// Opcode and length of a record whose content is `bytes` long.
  ByteSink& PutHead(std::uint8_t opcode, std::uint64_t bytes) { return Put(opcode).Put(bytes); }

 private:
  std::vector<std::uint8_t>& bytes_;
};

}  // namespace disflow::posix
