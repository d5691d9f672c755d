// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "disflow/hal/fault.h"

namespace disflow::posix {

/// How much a file unpacks to. Bytes that were made for it pack a million times over, so that a
/// megabyte would keep its reader busy for minutes; what cameras see, even of a scene without
/// noise and with little in it, does not pack two thousand times over for long.
class UnpackedTotal {
 public:
  static constexpr std::uint64_t kFree_bytes = std::uint64_t{256} << 20U;
  static constexpr std::uint64_t kMostTimes = 2000;
  /// bz2 takes 40 ns and more for a byte that was chosen to be slow, the others less than 1 ns: it
  /// may unpack to 25 times the file. Cameras' depth packs 3 to 10 times with it.
  static constexpr std::uint64_t kBzip2Weight = 80;
  static constexpr const char* kRefusal =
      "what is packed there is too long for so short a file, so it is left out";

  /// @param read_bytes Of the file, this included.
  /// @param weight Of a byte, for the time that unpacking it takes.
  /// @return False if it must not be unpacked; nothing is added then.
  [[nodiscard]] bool Add(std::uint64_t unpacked_bytes, std::uint64_t read_bytes,
                         std::uint64_t weight = 1) noexcept {
    const std::uint64_t cost = weight * unpacked_bytes;
    const bool fits = total_ + cost <= kFree_bytes + kMostTimes * read_bytes;
    if (fits) total_ += cost;
    return fits;
  }

 private:
  std::uint64_t total_ = 0;  ///< Bytes times their weights.
};

/// Unpacks what MCAP and bags pack: `lz4` (its frame format), `zstd`, `bz2`,
/// or nothing.
/// @param unpacked Is made as long as it has to become; the caller has bounded that.
/// @return kUnsupported for another packing; kCorrupt if it is damaged or of another length.
[[nodiscard]] hal::Fault Decompress(std::string_view compression,
                                    std::span<const std::uint8_t> packed,
                                    std::vector<std::uint8_t>& unpacked);

/// Unpacks a message that rosbag2 has packed by itself, if it has.
/// @param message Is pointed to `unpacked` then.
/// @param read_bytes Of the file, this message included.
[[nodiscard]] hal::Fault DecompressMessage(std::vector<std::uint8_t>& unpacked,
                                           std::span<std::uint8_t>& message, UnpackedTotal& total,
                                           std::uint64_t read_bytes);

}  // namespace disflow::posix
