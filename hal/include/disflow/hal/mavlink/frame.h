// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow/hal/little_endian.h"
#include "disflow/hal/mavlink/message_traits.h"
#include "disflow/status.h"

/// @file
/// MAVLink 2 framing: magic, header, payload without its trailing zeros, checksum.

namespace disflow::hal::mavlink {

inline constexpr std::uint8_t kMagic = 0xFD;
inline constexpr std::size_t kHeaderSize = 10;
inline constexpr std::size_t kChecksumSize = 2;
inline constexpr std::size_t kSignatureSize = 13;
inline constexpr std::size_t kMaxPayloadSize = 255;
inline constexpr std::size_t kMaxFrameSize =
    kHeaderSize + kMaxPayloadSize + kChecksumSize + kSignatureSize;
inline constexpr std::uint8_t kFlagSigned = 0x01;

/// Most bytes that one unsigned frame of this message takes.
template <class Message>
inline constexpr std::size_t kFrameSize = kHeaderSize + PayloadSize<Message>() + kChecksumSize;

/// @param frame At least kHeaderSize bytes.
[[nodiscard]] constexpr std::uint32_t MessageIdOf(std::span<const std::byte> frame) noexcept {
  const auto at = [frame](std::size_t i) { return std::to_integer<std::uint32_t>(frame[i]); };
  return at(7) | (at(8) << 8U) | (at(9) << 16U);
}

/// Who sends, and the number of the frame among that sender's.
struct FrameHeader {
  std::uint8_t sequence = 0;
  std::uint8_t system_id = 0;
  std::uint8_t component_id = 0;
};

/// A checked frame inside a decoder's buffer.
struct FrameView {
  FrameHeader header;
  std::uint32_t message_id = 0;
  bool is_signed = false;  ///< A signature followed; verified if the decoder had a session.
  std::span<const std::byte> payload;  ///< Without its trailing zeros.
};

/// Writes fields one after the other, little endian. The span must hold the whole payload.
class PayloadWriter {
 public:
  explicit constexpr PayloadWriter(std::span<std::byte> out) noexcept : out_(out) {}

  template <class T>
  constexpr void operator()(const char* /*name*/, const T& value,
                            FieldKind /*kind*/ = FieldKind::kBase) noexcept {
    Put(value);
  }
  template <class T, std::size_t kSize>
  constexpr void operator()(const char* /*name*/, const std::array<T, kSize>& values,
                            FieldKind /*kind*/ = FieldKind::kBase) noexcept {
    for (const T& value : values) Put(value);
  }

 private:
  template <class T>
  constexpr void Put(const T& value) noexcept {
    StoreLittleEndian(value, out_.subspan(position_));
    position_ += sizeof(T);
  }

  std::span<std::byte> out_;
  std::size_t position_ = 0;
};

/// Reads fields one after the other; bytes past the end are zeros, as truncation demands.
class PayloadReader {
 public:
  explicit constexpr PayloadReader(std::span<const std::byte> in) noexcept : in_(in) {}

  template <class T>
  constexpr void operator()(const char* /*name*/, T& value,
                            FieldKind /*kind*/ = FieldKind::kBase) noexcept {
    Get(value);
  }
  template <class T, std::size_t kSize>
  constexpr void operator()(const char* /*name*/, std::array<T, kSize>& values,
                            FieldKind /*kind*/ = FieldKind::kBase) noexcept {
    for (T& value : values) Get(value);
  }

 private:
  template <class T>
  constexpr void Get(T& value) noexcept {
    value = LoadLittleEndian<T>(in_.subspan(std::min(position_, in_.size())));
    position_ += sizeof(T);
  }

  std::span<const std::byte> in_;
  std::size_t position_ = 0;
};

/// Puts header and checksum around a payload that already lies at out[kHeaderSize...].
/// @param payload_size Before truncation; out holds at least kHeaderSize + payload_size +
/// kChecksumSize bytes.
/// @return Size of the whole frame.
[[nodiscard]] std::size_t SealFrame(const FrameHeader& header, std::uint32_t message_id,
                                    std::uint8_t crc_extra, std::size_t payload_size,
                                    std::span<std::byte> out) noexcept;

/// Writes one unsigned frame.
/// @param out At least kFrameSize<Message> bytes.
/// @return Bytes written, or kCapacityExceeded if `out` is too small (nothing is written then).
template <KnownMessage Message>
[[nodiscard]] Expected<std::size_t> EncodeFrame(const Message& message, const FrameHeader& header,
                                                std::span<std::byte> out) noexcept {
  if (out.size() < kFrameSize<Message>) return {0, Status::kCapacityExceeded};
  PayloadWriter writer(out.subspan(kHeaderSize));
  Message::VisitFields(message, writer);
  return {SealFrame(header, Message::kId, CrcExtra<Message>(), PayloadSize<Message>(), out)};
}

/// Takes a message out of a checked frame. Missing bytes are zeros, bytes of newer extensions are
/// ignored.
/// @return kOk, or kUnsupported if the frame carries another message (`message` is unchanged).
template <KnownMessage Message>
[[nodiscard]] Status DecodePayload(const FrameView& frame, Message& message) noexcept {
  if (frame.message_id != Message::kId) return Status::kUnsupported;
  PayloadReader reader(frame.payload);
  Message::VisitFields(message, reader);
  return Status::kOk;
}

}  // namespace disflow::hal::mavlink
