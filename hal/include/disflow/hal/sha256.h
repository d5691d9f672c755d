// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace disflow::hal {

/// SHA-256 of bytes that come in any pieces. Source: FIPS 180-4. The time taken depends on the
/// number of bytes alone, never on what they are.
class Sha256 {
 public:
  static constexpr std::size_t kDigestSize = 32;
  using Digest = std::array<std::byte, kDigestSize>;

  void Add(std::span<const std::byte> bytes) noexcept;
  /// @return The digest of all that was added. Nothing may be added afterwards.
  [[nodiscard]] Digest Finish() noexcept;

 private:
  static constexpr std::size_t kBlockSize = 64;

  void DigestBlock(std::span<const std::byte, kBlockSize> block) noexcept;

  /// FIPS 180-4, 5.3.3.
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::byte, kBlockSize> block_{};
  std::uint64_t size_ = 0;  ///< Bytes added so far.
};

}  // namespace disflow::hal
