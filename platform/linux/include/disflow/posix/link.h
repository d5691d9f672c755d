// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <variant>

#include "disflow/posix/serial_link.h"
#include "disflow/posix/tcp_link.h"
#include "disflow/posix/udp_link.h"

namespace disflow::posix {

/// A UDP, TCP or serial link, chosen by its address. Cannot be moved: keep it in a std::deque or an
/// array.
class Link {
 public:
  Link() = default;
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// Chooses and configures the link; does not open it.
  /// @param uri See hal::ParseLinkAddress().
  /// @return kOk or kInvalidUri.
  [[nodiscard]] hal::Fault Configure(std::string_view uri);

  /// @return The link, or null before Configure() succeeded.
  [[nodiscard]] hal::ByteLink* get() noexcept;
  /// What Configure() was given; what it says of keys, stamps, messages and choices is for who
  /// sends and decodes the messages.
  [[nodiscard]] const hal::LinkAddress& address() const noexcept { return address_; }
  /// What shows input when something can be received, for poll(); -1: nothing is open.
  [[nodiscard]] int fd() const noexcept;

 private:
  std::variant<std::monostate, UdpLink, TcpLink, SerialLink> link_;
  hal::LinkAddress address_;
};

}  // namespace disflow::posix
