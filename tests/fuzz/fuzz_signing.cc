// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "disflow/hal/mavlink/frame_decoder.h"

namespace {

using namespace disflow;
using namespace disflow::hal::mavlink;

void Require(bool condition) {
  if (!condition) std::abort();
}

constexpr SigningTime kNow = 34'725'264'567'800;

SigningKey KeyOf(std::uint8_t first) {
  SigningKey key{};
  key.fill(std::byte{0x5A});
  key[0] = std::byte{first};
  return key;
}

/// Frames of the stream that are accepted.
std::size_t Accepted(SigningSession& session, std::span<const std::byte> bytes) {
  FrameDecoder decoder;
  FrameView frame;
  std::size_t accepted = 0;
  while (!bytes.empty()) {
    const std::size_t taken = decoder.Feed(bytes);
    Require(taken > 0);
    bytes = bytes.subspan(taken);
    while (decoder.Next(frame, &session)) ++accepted;
  }
  Require(decoder.counters().frames == accepted);
  return accepted;
}

/// Nobody but who has the key can make a frame that is accepted, and that once only.
void CheckSigning(std::span<const std::byte> bytes, std::uint8_t choice) {
  SigningSession receiver(KeyOf(1), kNow);
  Require(Accepted(receiver, bytes) == 0);
  Require(receiver.time() == kNow);

  SigningSession sender(KeyOf(1), kNow);
  std::array<std::byte, kMaxFrameSize> frame{};
  // Whatever the bytes are, they are signed only if they are a frame.
  if (!sender.Sign(bytes.first(std::min(bytes.size(), kMaxFrameSize)), choice, frame).ok()) {
    DisflowStatus message;
    PayloadReader reader(bytes);
    DisflowStatus::VisitFields(message, reader);
    std::array<std::byte, kMaxFrameSize> plain{};
    const auto size = EncodeFrame(message, {.sequence = choice, .system_id = choice}, plain);
    Require(sender.Sign(std::span(plain).first(size.value), choice, frame).ok());
  }
  const std::size_t size =
      kHeaderSize + std::to_integer<std::size_t>(frame[1]) + kChecksumSize + kSignatureSize;
  std::array<std::byte, kMaxFrameSize> changed = frame;
  changed[choice % size] ^= std::byte{0x10};
  Require(Accepted(receiver, std::span(changed).first(size)) == 0);
  SigningSession stranger(KeyOf(2), kNow);
  Require(Accepted(stranger, std::span(frame).first(size)) == 0);
  Require(Accepted(receiver, std::span(frame).first(size)) == 1);
  Require(Accepted(receiver, std::span(frame).first(size)) == 0);
}

}  // namespace

/// The first byte chooses what is changed and who sends; the rest is a stream, and what is signed.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  CheckSigning(std::as_bytes(std::span(data + 1, size - 1)), data[0]);
  return 0;
}
