// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/depth_stream/packet_decoder.h"

#include "disflow/hal/depth_stream/crc32.h"
#include "disflow/hal/little_endian.h"
#include "disflow/saturating.h"

namespace disflow::hal::depth_stream {
namespace {

/// @return Decoded size, 0 if the code leads beyond the packet's end.
std::size_t DecodeInPlace(std::span<std::byte> bytes) noexcept {
  std::size_t out = 0;
  for (std::size_t in = 0; in < bytes.size();) {
    const auto code = std::to_integer<std::size_t>(bytes[in++]);
    if (in + code - 1 > bytes.size()) return 0;
    for (std::size_t i = 1; i < code; ++i) bytes[out++] = bytes[in++];
    if (code != 0xFF && in < bytes.size()) bytes[out++] = std::byte{0};
  }
  return out;
}

}  // namespace

bool PacketDecoder::Push(std::byte byte, PacketView& packet) noexcept {
  if (byte != std::byte{0}) {
    if (size_ < buffer_.size()) {
      buffer_[size_++] = byte;
    } else {
      too_long_ = true;
    }
    return false;
  }
  const std::size_t encoded_size = size_;
  const bool too_long = too_long_;
  size_ = 0;
  too_long_ = false;
  if (encoded_size == 0) return false;  // between packets
  if (!too_long && Finish(encoded_size, packet)) {
    AddSaturating(counters_.packets);
    return true;
  }
  AddSaturating(counters_.corrupt);
  return false;
}

bool PacketDecoder::Finish(std::size_t encoded_size, PacketView& packet) noexcept {
  const std::size_t size = DecodeInPlace(std::span(buffer_).first(encoded_size));
  if (size < kHeaderSize + kCrcSize) return false;
  const auto content = std::span<const std::byte>(buffer_).first(size - kCrcSize);
  const auto crc = std::span<const std::byte>(buffer_).subspan(size - kCrcSize);
  if (LoadLittleEndian<std::uint32_t>(crc) != Crc32(content)) return false;
  packet.type = static_cast<PacketType>(std::to_integer<std::uint8_t>(content[0]));
  packet.sequence = LoadLittleEndian<std::uint32_t>(content.subspan(1));
  packet.payload = content.subspan(kHeaderSize);
  return true;
}

}  // namespace disflow::hal::depth_stream
