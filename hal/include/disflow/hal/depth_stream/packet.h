// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/types.h"

/// @file
/// Depth images over a serial line, to a controller that has no camera of its own. What a byte
/// means: docs/firmware.md.
///
/// A frame is cut into packets. Each is checked by a CRC-32 and coded without zero bytes (COBS,
/// Cheshire and Baker 1999), so that a zero always ends a packet: after garbage the receiver is
/// back in step at the next packet.

namespace disflow::hal::depth_stream {

enum class PacketType : std::uint8_t {
  kStart = 1,    ///< FrameStart.
  kPixels = 2,   ///< Index of the first pixel, then depths, see EncodePixels().
  kEnd = 3,      ///< The frame is complete; no payload.
  kPoll = 4,     ///< "Are you there?"; no payload.
  kBudgets = 5,  ///< TimeBudgets.
};

/// What is known of an image before its pixels.
struct FrameStart {
  StampNs stamp_ns = 0;
  std::uint16_t width_px = 0;
  std::uint16_t height_px = 0;
  float unit_m = 0.0F;  ///< Metres per unit; depth 0 = no data.
  PinholeCamera camera;
};

/// How long the work on a frame may take; 0 = no limit.
struct TimeBudgets {
  std::uint32_t frame_us = 0;  ///< Beyond it the controller restarts.
  std::uint32_t stage_us = 0;  ///< Beyond it a stage is counted as late.
};

inline constexpr std::size_t kMaxPixelsPerPacket = 128;
inline constexpr std::size_t kHeaderSize = 5;  ///< Type and sequence number.
inline constexpr std::size_t kCrcSize = 4;
/// Three bytes per pixel at worst.
inline constexpr std::size_t kMaxPacketSize = kHeaderSize + 4 + 3 * kMaxPixelsPerPacket + kCrcSize;
/// Encoded: one byte more per 254, and a delimiter at either end.
inline constexpr std::size_t kMaxEncodedSize = kMaxPacketSize + kMaxPacketSize / 254 + 1 + 2;
using EncodedPacket = std::array<std::byte, kMaxEncodedSize>;

/// A packet whose checksum was correct.
struct PacketView {
  PacketType type = PacketType::kPoll;
  std::uint32_t sequence = 0;  ///< Grows with every frame and every poll; frames keep theirs.
  std::span<const std::byte> payload;
};

// Each writes one packet, delimiters included, and returns the part of `out` that it fills.
[[nodiscard]] std::span<const std::byte> EncodeStart(std::uint32_t sequence,
                                                     const FrameStart& start,
                                                     EncodedPacket& out) noexcept;
/// @param depths At most kMaxPixelsPerPacket; the packet holds their differences, seven bits a
/// byte: neighbouring depths differ little, so that most take one byte.
[[nodiscard]] std::span<const std::byte> EncodePixels(std::uint32_t sequence,
                                                      std::uint32_t first_index,
                                                      std::span<const std::uint16_t> depths,
                                                      EncodedPacket& out) noexcept;
[[nodiscard]] std::span<const std::byte> EncodeEnd(std::uint32_t sequence,
                                                   EncodedPacket& out) noexcept;
[[nodiscard]] std::span<const std::byte> EncodePoll(std::uint32_t sequence,
                                                    EncodedPacket& out) noexcept;
[[nodiscard]] std::span<const std::byte> EncodeBudgets(std::uint32_t sequence,
                                                       const TimeBudgets& budgets,
                                                       EncodedPacket& out) noexcept;

// Each reads a payload; false if its size or content cannot be right.
[[nodiscard]] bool DecodeStart(std::span<const std::byte> payload, FrameStart& start) noexcept;
[[nodiscard]] bool DecodeBudgets(std::span<const std::byte> payload, TimeBudgets& budgets) noexcept;
/// Writes the pixels of a packet into an image.
/// @param next_index The pixel that is due; moved on. A packet that starts elsewhere is refused.
[[nodiscard]] bool DecodePixels(std::span<const std::byte> payload, std::span<std::uint16_t> image,
                                std::size_t& next_index) noexcept;

}  // namespace disflow::hal::depth_stream
