// SPDX-License-Identifier: BSD-3-Clause
#include "client_frames.h"

namespace disflow::posix {
namespace {

constexpr unsigned kFin = 0x80;
constexpr unsigned kReserved = 0x70;
constexpr unsigned kOpcode = 0x0F;
constexpr unsigned kMasked = 0x80;
constexpr unsigned kLength = 0x7F;

enum Opcode : unsigned { kContinuation, kText, kBinary, kCloseCode = 8, kPingCode, kPongCode };

bool IsControl(unsigned opcode) noexcept { return (opcode & kCloseCode) != 0; }

/// By its first byte.
ClientFrame Kind(unsigned first) noexcept {
  const bool is_whole = (first & kFin) != 0;
  if ((first & kReserved) != 0) return ClientFrame::kMalformed;
  if (IsControl(first & kOpcode) && !is_whole) return ClientFrame::kMalformed;
  switch (first & kOpcode) {
    case kContinuation:
    case kText:
      return ClientFrame::kNotAllowed;
    case kBinary:
      return is_whole ? ClientFrame::kMessage : ClientFrame::kNotAllowed;
    case kCloseCode:
      return ClientFrame::kClose;
    case kPingCode:
      return ClientFrame::kPing;
    case kPongCode:
      return ClientFrame::kPong;
    default:
      return ClientFrame::kMalformed;
  }
}

bool IsWrong(ClientFrame frame) noexcept {
  return frame == ClientFrame::kMalformed || frame == ClientFrame::kNotAllowed;
}

}  // namespace

std::optional<ClientFrame> ClientFrames::Take(std::span<const std::uint8_t>& bytes) noexcept {
  while (!bytes.empty()) {
    bytes_[count_++] = bytes.front();
    bytes = bytes.subspan(1);
    const std::optional<ClientFrame> frame = Judge();
    if (!frame) continue;
    count_ = 0;
    return frame;
  }
  return std::nullopt;
}

/// Once as much of a frame has come as there is.
std::optional<ClientFrame> ClientFrames::Judge() noexcept {
  if (count_ < 2) return std::nullopt;
  const ClientFrame kind = Kind(bytes_[0]);
  length_ = bytes_[1] & kLength;
  const bool is_long = length_ > kMostPayload_bytes;
  if (is_long) length_ = 0;
  if ((bytes_[1] & kMasked) == 0) return ClientFrame::kMalformed;
  if (IsWrong(kind)) return kind;
  if (is_long)
    return IsControl(bytes_[0] & kOpcode) ? ClientFrame::kMalformed : ClientFrame::kNotAllowed;
  if (count_ < kHeadBytes + length_) return std::nullopt;
  for (std::size_t i = 0; i < length_; ++i) bytes_[kHeadBytes + i] ^= bytes_[2 + i % 4];
  return kind;
}

}  // namespace disflow::posix
