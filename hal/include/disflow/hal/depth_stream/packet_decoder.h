// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "disflow/hal/depth_stream/packet.h"

namespace disflow::hal::depth_stream {

/// What the decoder has come across; saturating.
struct PacketCounters {
  std::uint32_t packets = 0;  ///< With a correct checksum.
  std::uint32_t corrupt = 0;  ///< Too long, too short, badly encoded or with a wrong checksum.
};

/// Finds the packets in a stream of bytes that may start anywhere and contain anything. Fixed
/// memory; not thread-safe.
class PacketDecoder {
 public:
  /// @param packet The packet that this byte completed; its payload stays valid until the next
  /// call.
  /// @return Whether there is one (`packet` is unchanged otherwise).
  [[nodiscard]] bool Push(std::byte byte, PacketView& packet) noexcept;

  [[nodiscard]] const PacketCounters& counters() const noexcept { return counters_; }

 private:
  [[nodiscard]] bool Finish(std::size_t encoded_size, PacketView& packet) noexcept;

  std::array<std::byte, kMaxEncodedSize> buffer_{};
  std::size_t size_ = 0;
  bool too_long_ = false;
  PacketCounters counters_;
};

}  // namespace disflow::hal::depth_stream
