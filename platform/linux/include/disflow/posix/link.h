// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "disflow/posix/serial_link.h"
#include "disflow/posix/udp_link.h"

namespace disflow::posix {

/// A UDP or serial link, chosen by its address. Cannot be moved: keep it in a std::deque or an
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
  /// File with the key that messages are to be signed with, empty for none: who sends and decodes
  /// the messages has to see to it.
  [[nodiscard]] const std::string& key_file() const noexcept { return key_file_; }

  /// See hal::LinkAddress.
  [[nodiscard]] bool may_choose() const noexcept { return may_choose_; }

 private:
  std::variant<std::monostate, UdpLink, SerialLink> link_;
  std::string key_file_;
  bool may_choose_ = false;
};

}  // namespace disflow::posix
