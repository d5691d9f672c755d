// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string_view>

#include "disflow/hal/fault.h"

namespace disflow::hal {

/// Where a ByteLink goes, taken apart. Texts are zero-terminated copies.
struct LinkAddress {
  enum class Kind : std::uint8_t { kUdp, kTcp, kSerial };
  /// Clock of the stamps that are sent.
  enum class Stamps : std::uint8_t {
    kCapture,    ///< The depth images' own.
    kMonotonic,  ///< This machine's CLOCK_MONOTONIC.
    kEpoch,      ///< Time since 1970.
    kAutopilot,  ///< That of the autopilot at the other end, learnt by TIMESYNC.
  };
  /// The message that carries a pose.
  enum class Pose : std::uint8_t { kOdometry, kLandingTarget, kFollowTarget };

  static constexpr std::uint32_t kDefaultBaud = 921600;
  static constexpr std::size_t kMaxHostLength = 253;  ///< RFC 1035.
  static constexpr std::size_t kMaxDeviceLength = 127;
  static constexpr std::size_t kMaxKeyFileLength = 255;

  Kind kind = Kind::kUdp;
  char host[kMaxHostLength + 1] = {};      ///< UDP, TCP: name, IPv4 or IPv6 address (no brackets).
  std::uint16_t port = 0;                  ///< UDP, TCP: the peer's, or where to listen.
  bool listens = false;                    ///< TCP: host and port are the own ones.
  std::uint16_t bind_port = 0;             ///< UDP: own port, 0 = any.
  char device[kMaxDeviceLength + 1] = {};  ///< Serial: path, e.g. "/dev/ttyUSB0".
  std::uint32_t baud = kDefaultBaud;       ///< Serial: bits per second.
  /// File with the key by which messages are signed; empty: they are not.
  char key_file[kMaxKeyFileLength + 1] = {};
  /// Whoever is at the other end may choose what is tracked.
  bool may_choose = false;
  Stamps stamps = Stamps::kCapture;
  Pose pose = Pose::kOdometry;
};

/// Reads `udp://HOST:PORT[?bind=PORT]`, `tcp://HOST:PORT[?listen=yes]` or
/// `serial:///dev/NAME[?baud=RATE]`, all also with `key=FILE`, `choose=yes`,
/// `stamps=monotonic|epoch|autopilot` and `send=landing_target|follow_target`; options are parted
/// by '&'. IPv6 addresses are written in brackets: `udp://[::1]:14550`.
/// @param address Unchanged unless the result is ok.
/// @return kInvalidUri with the part that is wrong and what it should look like.
[[nodiscard]] Fault ParseLinkAddress(std::string_view uri, LinkAddress& address) noexcept;

}  // namespace disflow::hal
