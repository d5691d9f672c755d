// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <zlib.h>

#include <array>
#include <cstdint>
#include <span>

/// @file
/// Numbers and checksum of the MCAP format, version 0 (https://mcap.dev/spec).

namespace disflow::posix::mcap {

inline constexpr std::array<std::uint8_t, 8> kMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Of a record: its opcode and the length of what follows.
inline constexpr std::uint64_t kRecordHeadBytes = 9;
/// Of a message: channel, sequence, times of logging and publishing.
inline constexpr std::uint64_t kMessageHeadBytes = 22;
/// Start of the summary, start of its offsets, checksum.
inline constexpr std::uint64_t kFooterBytes = 20;
inline constexpr std::uint64_t kDataEndBytes = 4;

/// @param crc Of what lies before; 0 at the beginning.
[[nodiscard]] inline std::uint32_t Crc32(std::uint32_t crc,
                                         std::span<const std::uint8_t> bytes) noexcept {
  return static_cast<std::uint32_t>(::crc32_z(crc, bytes.data(), bytes.size()));
}

}  // namespace disflow::posix::mcap
