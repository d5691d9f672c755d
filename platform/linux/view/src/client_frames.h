// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace disflow::posix {

/// What a browser's next frame is.
enum class ClientFrame : std::uint8_t {
  kMessage,  ///< A whole binary message.
  kPing,
  kPong,
  kClose,
  kMalformed,   ///< RFC 6455 forbids it: a server hangs up with status 1002.
  kNotAllowed,  ///< This server takes none such: it hangs up with status 1008.
};

/// Takes apart what a browser sends over a WebSocket (RFC 6455, section 5.2), however it arrives in
/// pieces. libwebsockets does as much, but passes on frames that are not masked like others, which
/// section 5.1 forbids, and does not tell. Frames of more than 125 bytes and messages of several
/// are not allowed: nobody has reason to send any.
class ClientFrames {
 public:
  /// Takes bytes from the front of `bytes` until a frame is known; none is after one that is wrong.
  /// @return Nothing if there have to be more bytes.
  [[nodiscard]] std::optional<ClientFrame> Take(std::span<const std::uint8_t>& bytes) noexcept;

  /// Of the frame that was returned last, until the next call.
  [[nodiscard]] std::span<const std::uint8_t> payload() const noexcept {
    return std::span(bytes_).subspan(kHeadBytes, length_);
  }

 private:
  static constexpr std::size_t kMostPayload_bytes = 125;
  static constexpr std::size_t kHeadBytes = 6;  ///< Bits and opcode, length, mask.

  [[nodiscard]] std::optional<ClientFrame> Judge() noexcept;

  std::array<std::uint8_t, kHeadBytes + kMostPayload_bytes> bytes_{};
  std::size_t count_ = 0;
  std::size_t length_ = 0;  ///< Of the payload.
};

}  // namespace disflow::posix
