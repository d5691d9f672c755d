// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/mavlink/frame.h"

namespace disflow::hal::mavlink {

std::size_t SealFrame(const FrameHeader& header, std::uint32_t message_id, std::uint8_t crc_extra,
                      std::size_t payload_size, std::span<std::byte> out) noexcept {
  // MAVLink 2 drops trailing zeros, but never the first byte.
  while (payload_size > 1 && out[kHeaderSize + payload_size - 1] == std::byte{0}) --payload_size;

  const std::array<std::uint8_t, kHeaderSize> bytes{kMagic,
                                                    static_cast<std::uint8_t>(payload_size),
                                                    0,  // incompatibility flags
                                                    0,  // compatibility flags
                                                    header.sequence,
                                                    header.system_id,
                                                    header.component_id,
                                                    static_cast<std::uint8_t>(message_id),
                                                    static_cast<std::uint8_t>(message_id >> 8U),
                                                    static_cast<std::uint8_t>(message_id >> 16U)};
  for (std::size_t i = 0; i < kHeaderSize; ++i) out[i] = static_cast<std::byte>(bytes[i]);

  const std::size_t end = kHeaderSize + payload_size;
  Crc crc;
  crc.Add(out.subspan(1, end - 1));
  crc.Add(crc_extra);
  StoreLittleEndian(crc.value(), out.subspan(end));
  return end + kChecksumSize;
}

}  // namespace disflow::hal::mavlink
