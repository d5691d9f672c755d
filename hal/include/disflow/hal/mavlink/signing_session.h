// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "disflow/memory/fixed_vector.h"
#include "disflow/status.h"

/// @file
/// MAVLink 2 message signing. Source: MAVLink guide, "Message Signing (Authentication)".

namespace disflow::hal::mavlink {

/// The secret that both ends of a link share.
using SigningKey = std::array<std::byte, 32>;

/// Units of 10 us since 1 January 2015, 48 bits.
using SigningTime = std::uint64_t;
inline constexpr SigningTime kMaxSigningTime = (SigningTime{1} << 48U) - 1;
inline constexpr SigningTime kSigningMinute = 6'000'000;

/// @param unix_ns Nanoseconds since 1 January 1970, as CLOCK_REALTIME counts them.
/// @return 0 for what was before 2015.
[[nodiscard]] constexpr SigningTime SigningTimeOf(std::int64_t unix_ns) noexcept {
  constexpr std::int64_t kUnit_ns = 10'000;
  constexpr std::int64_t kStart_ns = 1'420'070'400LL * 1'000'000'000LL;
  if (unix_ns < kStart_ns) return 0;
  return std::min(static_cast<SigningTime>((unix_ns - kStart_ns) / kUnit_ns), kMaxSigningTime);
}

/// What becomes of a frame that came in.
enum class SignatureVerdict : std::uint8_t {
  kAccepted,
  kUnsigned,  ///< It carries no signature.
  kWrong,     ///< Made with another key, or something of the frame was changed.
  kReplayed,  ///< Its stream was already as far, or it is an echo of an own frame.
  kOutdated,  ///< Signed more than a minute ago.
  kNoRoom,    ///< Of a new stream, and the table of streams is full.
};

/// Signs what is sent and judges what comes in with one key, over any number of links.
///
/// All links that use a key share one session: else what was sent over one could be replayed on
/// another. A signature proves who sent a frame and when; it hides nothing. Has no clock: call
/// AdvanceTo() before frames are sent or received. Fixed memory; not thread-safe.
class SigningSession {
 public:
  /// Senders that are remembered, each (system, component, link). They are never forgotten, or
  /// their frames could be replayed.
  static constexpr int kMaxStreams = 32;

  /// @param start At least as late as any time that was signed with this key before a restart.
  /// @param own_system_id Frames that claim to come from it are echoes; 0: there are none such.
  SigningSession(const SigningKey& key, SigningTime start, std::uint8_t own_system_id = 0) noexcept
      : key_(key), time_(std::min(start, kMaxSigningTime)), own_system_id_(own_system_id) {}
  SigningSession(const SigningSession&) = delete;
  SigningSession& operator=(const SigningSession&) = delete;
  /// Leaves no key in memory.
  ~SigningSession();

  /// @param now Of the system's clock. An earlier one than time() changes nothing.
  void AdvanceTo(SigningTime now) noexcept {
    time_ = std::max(time_, std::min(now, kMaxSigningTime));
  }
  /// The latest of the clock and of all times signed or accepted.
  [[nodiscard]] SigningTime time() const noexcept { return time_; }
  [[nodiscard]] bool HasKey(const SigningKey& key) const noexcept;

  /// Writes a frame with its signature.
  /// @param frame Unsigned, of a known message, as EncodeFrame() made it.
  /// @param link_id Number of the link that the frame is for; each link has one of its own.
  /// @param out At least kSignatureSize more than `frame`; the two must not overlap.
  /// @return Bytes written; or kUnsupported if `frame` is not such a frame, kCapacityExceeded if
  /// `out` is too small or no later time is left, which happens in 2104 or after a peer said so.
  [[nodiscard]] Expected<std::size_t> Sign(std::span<const std::byte> frame, std::uint8_t link_id,
                                           std::span<std::byte> out) noexcept;

  /// @param frame Whole, with a correct checksum, and with its signature if it has one.
  [[nodiscard]] SignatureVerdict Check(std::span<const std::byte> frame) noexcept;

 private:
  struct Stream {
    std::uint8_t system_id = 0;
    std::uint8_t component_id = 0;
    std::uint8_t link_id = 0;
    SigningTime time = 0;
  };
  static constexpr std::size_t kSignatureBytes = 6;
  using Signature = std::array<std::byte, kSignatureBytes>;

  [[nodiscard]] Signature SignatureOf(std::span<const std::byte> signed_part) const noexcept;
  /// What remains to be asked of a frame whose signature is right.
  [[nodiscard]] SignatureVerdict CheckTime(const Stream& claimed) noexcept;

  SigningKey key_;
  SigningTime time_;
  std::uint8_t own_system_id_;
  FixedVector<Stream, kMaxStreams> streams_;
};

}  // namespace disflow::hal::mavlink
