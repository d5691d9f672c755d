// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "disflow/hal/mavlink/frame.h"
#include "disflow/hal/mavlink/signing_session.h"

namespace disflow::hal::mavlink {

/// What the decoder has come across; saturating.
struct DecoderCounters {
  std::uint32_t frames = 0;             ///< Complete, with a correct checksum, not refused below.
  std::uint32_t bad_checksum = 0;       ///< Known message, wrong checksum.
  std::uint32_t unknown_id = 0;         ///< Headers of messages that DisFlow does not know.
  std::uint32_t unsupported_flags = 0;  ///< Headers with incompatibility flags other than "signed".
  std::uint32_t skipped_bytes = 0;      ///< Bytes that belong to no accepted frame.

  // Refused by the signing session, see SignatureVerdict.
  std::uint32_t without_signature = 0;
  std::uint32_t wrong_signature = 0;
  std::uint32_t replayed = 0;
  std::uint32_t outdated = 0;
  std::uint32_t streams_refused = 0;
};

/// Finds the MAVLink 2 frames of known messages in a stream of bytes that may start anywhere and
/// contain anything.
///
/// When a presumed header turns out not to be one, the search resumes at the very next byte, so
/// that garbage never costs the frame that follows it. Fixed memory; not thread-safe.
///
/// ForEachFrame() is all that most callers need; Feed() and Next() are for those that stop in
/// between.
class FrameDecoder {
 public:
  /// Takes as many bytes as fit; always at least one if Next() was called until it returned false.
  /// @return Number of bytes taken from the front of `bytes`.
  [[nodiscard]] std::size_t Feed(std::span<const std::byte> bytes) noexcept;

  /// @param frame The next whole frame; its payload stays valid until the next call of Feed() or
  /// Next().
  /// @param session If given, frames that it does not accept are counted and left out. Without,
  /// signatures are passed over and unsigned frames are as good as signed ones.
  /// @return false if more bytes are needed (`frame` is unchanged then).
  [[nodiscard]] bool Next(FrameView& frame, SigningSession* session = nullptr) noexcept;

  /// Takes all of `bytes`, and calls use(const FrameView&) for every frame that they complete; its
  /// payload is valid until `use` returns.
  /// @param session As for Next(); may be null.
  template <class Use>
  void ForEachFrame(std::span<const std::byte> bytes, SigningSession* session, Use&& use) noexcept {
    FrameView frame;
    while (!bytes.empty()) {
      bytes = bytes.subspan(Feed(bytes));
      while (Next(frame, session)) use(std::as_const(frame));
    }
  }

  [[nodiscard]] const DecoderCounters& counters() const noexcept { return counters_; }

 private:
  enum class Verdict : std::uint8_t { kIncomplete, kGarbage, kFrame };

  [[nodiscard]] Verdict Examine(std::size_t& frame_size) noexcept;
  [[nodiscard]] bool IsAuthentic(SigningSession& session, std::size_t frame_size) noexcept;
  void SkipToMagic() noexcept;
  [[nodiscard]] std::uint8_t At(std::size_t offset) const noexcept {
    return std::to_integer<std::uint8_t>(buffer_[begin_ + offset]);
  }
  [[nodiscard]] std::uint32_t MessageId() const noexcept {
    return MessageIdOf(std::span(buffer_).subspan(begin_));
  }

  std::array<std::byte, kMaxFrameSize> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  DecoderCounters counters_;
};

}  // namespace disflow::hal::mavlink
