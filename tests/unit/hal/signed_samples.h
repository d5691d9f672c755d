// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/hal/mavlink/signing_session.h"
#include "wire_samples.h"

/// @file
/// Keys, and short ways to sign and to judge.

namespace disflow::hal::mavlink::testing {

/// A day in 2026.
inline constexpr SigningTime kNow = 34'725'264'567'800;

[[nodiscard]] constexpr SigningKey KeyNumber(unsigned number) {
  SigningKey key{};
  for (unsigned i = 0; i < key.size(); ++i) key[i] = static_cast<std::byte>(i * 7 + number);
  return key;
}
inline constexpr SigningKey kKey = KeyNumber(3);

/// Signed at `time`, or as the next one if the session is already as far.
[[nodiscard]] inline Bytes Signed(SigningSession& session, SigningTime time, const Bytes& frame,
                                  std::uint8_t link_id = 0) {
  if (time > 0) session.AdvanceTo(time - 1);
  Bytes bytes(kMaxFrameSize);
  const auto size = session.Sign(frame, link_id, bytes);
  bytes.resize(size.ok() ? size.value : 0);
  return bytes;
}
[[nodiscard]] inline Bytes Signed(SigningTime time, const Bytes& frame, std::uint8_t link_id = 0) {
  SigningSession session(kKey, 0);
  return Signed(session, time, frame, link_id);
}

/// @return Number of frames that are accepted.
[[nodiscard]] inline std::size_t Accepted(FrameDecoder& decoder, SigningSession& session,
                                          std::span<const std::byte> bytes) {
  std::size_t accepted = 0;
  FrameView frame;
  while (!bytes.empty()) {
    bytes = bytes.subspan(decoder.Feed(bytes));
    while (decoder.Next(frame, &session)) ++accepted;
  }
  return accepted;
}

}  // namespace disflow::hal::mavlink::testing
