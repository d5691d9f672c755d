// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/hal/depth_stream/packet.h"

#include <algorithm>

#include "disflow/hal/depth_stream/crc32.h"
#include "disflow/hal/little_endian.h"

namespace disflow::hal::depth_stream {
namespace {

constexpr std::size_t kStartSize = 8 + 2 + 2 + 5 * 4;
constexpr std::size_t kBudgetsSize = 2 * 4;

/// Writes a packet as it is before coding, little endian.
class Composer {
 public:
  Composer(PacketType type, std::uint32_t sequence) noexcept {
    Put(static_cast<std::uint8_t>(type));
    Put(sequence);
  }
  template <class Number>
  void Put(Number value) noexcept {
    StoreLittleEndian(value, std::span(bytes_).subspan(size_));
    size_ += sizeof(Number);
  }

  /// Appends the checksum and codes all so that no byte is zero but the delimiters.
  std::span<const std::byte> Seal(EncodedPacket& out) noexcept {
    Put(Crc32(std::span(bytes_).first(size_)));
    std::size_t code_at = 1;  // where the distance to the next zero goes
    std::size_t next = 2;
    std::uint8_t code = 1;
    out[0] = std::byte{0};
    for (std::size_t i = 0; i < size_; ++i) {
      if (bytes_[i] != std::byte{0}) {
        out[next++] = bytes_[i];
        ++code;
      }
      if (bytes_[i] == std::byte{0} || code == 0xFF) {
        out[code_at] = std::byte{code};
        code_at = next++;
        code = 1;
      }
    }
    out[code_at] = std::byte{code};
    out[next++] = std::byte{0};
    return std::span<const std::byte>(out).first(next);
  }

 private:
  std::array<std::byte, kMaxPacketSize> bytes_{};
  std::size_t size_ = 0;
};

/// Reads a payload, little endian.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) noexcept : bytes_(bytes) {}
  template <class Number>
  [[nodiscard]] Number Get() noexcept {
    const auto value = LoadLittleEndian<Number>(bytes_.subspan(next_));
    next_ += sizeof(Number);
    return value;
  }
  [[nodiscard]] bool empty() const noexcept { return next_ >= bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t next_ = 0;
};

}  // namespace

std::span<const std::byte> EncodeStart(std::uint32_t sequence, const FrameStart& start,
                                       EncodedPacket& out) noexcept {
  Composer packet(PacketType::kStart, sequence);
  packet.Put(static_cast<std::uint64_t>(start.stamp_ns));
  packet.Put(start.width_px);
  packet.Put(start.height_px);
  packet.Put(start.unit_m);
  packet.Put(start.camera.fx_px);
  packet.Put(start.camera.fy_px);
  packet.Put(start.camera.cx_px);
  packet.Put(start.camera.cy_px);
  return packet.Seal(out);
}

std::span<const std::byte> EncodePixels(std::uint32_t sequence, std::uint32_t first_index,
                                        std::span<const std::uint16_t> depths,
                                        EncodedPacket& out) noexcept {
  Composer packet(PacketType::kPixels, sequence);
  packet.Put(first_index);
  std::int32_t previous = 0;
  for (const std::uint16_t depth : depths.first(std::min(depths.size(), kMaxPixelsPerPacket))) {
    const std::int32_t difference = std::int32_t{depth} - previous;
    previous = depth;
    // 0, -1, 1, -2, ... become 0, 1, 2, 3, ...
    auto rest = (static_cast<std::uint32_t>(difference) << 1U) ^
                static_cast<std::uint32_t>(difference >> 31);
    while (rest >= 0x80) {
      packet.Put(static_cast<std::uint8_t>(rest | 0x80U));
      rest >>= 7U;
    }
    packet.Put(static_cast<std::uint8_t>(rest));
  }
  return packet.Seal(out);
}

std::span<const std::byte> EncodeEnd(std::uint32_t sequence, EncodedPacket& out) noexcept {
  return Composer(PacketType::kEnd, sequence).Seal(out);
}

std::span<const std::byte> EncodePoll(std::uint32_t sequence, EncodedPacket& out) noexcept {
  return Composer(PacketType::kPoll, sequence).Seal(out);
}

std::span<const std::byte> EncodeBudgets(std::uint32_t sequence, const TimeBudgets& budgets,
                                         EncodedPacket& out) noexcept {
  Composer packet(PacketType::kBudgets, sequence);
  packet.Put(budgets.frame_us);
  packet.Put(budgets.stage_us);
  return packet.Seal(out);
}

bool DecodeStart(std::span<const std::byte> payload, FrameStart& start) noexcept {
  if (payload.size() != kStartSize) return false;
  Reader reader(payload);
  start.stamp_ns = static_cast<StampNs>(reader.Get<std::uint64_t>());
  start.width_px = reader.Get<std::uint16_t>();
  start.height_px = reader.Get<std::uint16_t>();
  start.unit_m = reader.Get<float>();
  start.camera.fx_px = reader.Get<float>();
  start.camera.fy_px = reader.Get<float>();
  start.camera.cx_px = reader.Get<float>();
  start.camera.cy_px = reader.Get<float>();
  return true;
}

bool DecodeBudgets(std::span<const std::byte> payload, TimeBudgets& budgets) noexcept {
  if (payload.size() != kBudgetsSize) return false;
  Reader reader(payload);
  budgets.frame_us = reader.Get<std::uint32_t>();
  budgets.stage_us = reader.Get<std::uint32_t>();
  return true;
}

bool DecodePixels(std::span<const std::byte> payload, std::span<std::uint16_t> image,
                  std::size_t& next_index) noexcept {
  constexpr int kMaxShift = 14;
  constexpr std::int32_t kMaxDepth = 0xFFFF;
  if (payload.size() < 4) return false;
  Reader reader(payload);
  if (reader.Get<std::uint32_t>() != next_index) return false;
  std::int32_t depth = 0;
  while (!reader.empty()) {
    std::uint32_t code = 0;
    int shift = 0;
    for (;; shift += 7) {
      if (shift > kMaxShift || reader.empty()) return false;
      const auto byte = reader.Get<std::uint8_t>();
      code |= (std::uint32_t{byte} & 0x7FU) << shift;
      if (byte < 0x80) break;
    }
    const std::uint32_t sign = 0U - (code & 1U);
    depth += static_cast<std::int32_t>((code >> 1U) ^ sign);
    if (depth < 0 || depth > kMaxDepth || next_index >= image.size()) return false;
    image[next_index++] = static_cast<std::uint16_t>(depth);
  }
  return true;
}

}  // namespace disflow::hal::depth_stream
