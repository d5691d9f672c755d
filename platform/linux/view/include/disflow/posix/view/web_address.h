// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "disflow/hal/fault.h"

namespace disflow::posix {

/// Where a web server listens.
struct WebAddress {
  std::string host = "127.0.0.1";  ///< IPv4 or IPv6 address, no name.
  int port = 0;                    ///< 0: any that is free.
  bool is_ipv6 = false;
  /// Only programs of this machine reach it.
  bool is_loopback = true;
  /// Asked for by name: every program and user of this machine may look and use the buttons.
  bool without_token = false;

  /// @param port The port that is listened on.
  /// @return What to type into a browser of this machine.
  [[nodiscard]] std::string Url(int port) const;
};

/// @param text HOST:PORT, :PORT or PORT; HOST is an IPv4 address, an IPv6 address in brackets or
/// localhost. Without it: loopback. On loopback `?token=none` may follow.
/// @return kInvalidUri.
[[nodiscard]] hal::Fault ParseWebAddress(std::string_view text, WebAddress& address);

}  // namespace disflow::posix
