// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/frame_decoder.h"

/// @file
/// Messages with a different value in every field, and short ways through encoder and decoder.

namespace disflow::hal::mavlink::testing {

using Bytes = std::vector<std::byte>;

/// Gives field number k of a message the value k + offset, so that swapped fields are noticed.
class FillVisitor {
 public:
  explicit FillVisitor(int offset) : next_(offset) {}

  template <class T>
  void operator()(const char* /*name*/, T& value, FieldKind /*kind*/ = FieldKind::kBase) {
    value = static_cast<T>(next_++);
  }
  template <class T, std::size_t kSize>
  void operator()(const char* /*name*/, std::array<T, kSize>& values,
                  FieldKind /*kind*/ = FieldKind::kBase) {
    for (T& value : values) value = static_cast<T>(next_++);
  }

 private:
  int next_;
};

template <class Message>
[[nodiscard]] Message Filled(int offset = 1) {
  Message message;
  FillVisitor fill(offset);
  Message::VisitFields(message, fill);
  return message;
}

inline constexpr FrameHeader kSender{.sequence = 7, .system_id = 190, .component_id = 25};

template <class Message>
[[nodiscard]] Bytes Encoded(const Message& message, const FrameHeader& header = kSender) {
  Bytes bytes(kMaxFrameSize);
  const auto size = EncodeFrame(message, header, bytes);
  bytes.resize(size.ok() ? size.value : 0);
  return bytes;
}

/// A frame with its payload copied, since views die with the next call of the decoder.
struct OwnedFrame {
  FrameView view;
  Bytes payload;
};

/// Feeds in pieces of `step` bytes and returns all frames.
[[nodiscard]] inline std::vector<OwnedFrame> DecodeAll(FrameDecoder& decoder,
                                                       std::span<const std::byte> bytes,
                                                       std::size_t step = kMaxFrameSize) {
  std::vector<OwnedFrame> frames;
  FrameView view;
  while (!bytes.empty()) {
    const std::size_t taken = decoder.Feed(bytes.first(std::min(step, bytes.size())));
    if (taken == 0) return frames;
    bytes = bytes.subspan(taken);
    while (decoder.Next(view)) {
      frames.push_back({view, Bytes(view.payload.begin(), view.payload.end())});
      frames.back().view.payload = frames.back().payload;
    }
  }
  return frames;
}

[[nodiscard]] inline Bytes RandomBytes(std::size_t size, std::uint32_t seed) {
  std::mt19937 random(seed);
  Bytes bytes(size);
  for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  return bytes;
}

/// Gives the checksum back its truth after a frame was changed by hand.
inline void FixChecksum(Bytes& frame, std::uint8_t crc_extra) {
  const std::size_t end = kHeaderSize + std::to_integer<std::size_t>(frame[1]);
  Crc crc;
  crc.Add(std::span<const std::byte>(frame).subspan(1, end - 1));
  crc.Add(crc_extra);
  frame[end] = static_cast<std::byte>(crc.value() & 0xFF);
  frame[end + 1] = static_cast<std::byte>(crc.value() >> 8);
}

inline void Append(Bytes& bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

}  // namespace disflow::hal::mavlink::testing
