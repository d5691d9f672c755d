// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/link.h"

#include <type_traits>

namespace disflow::posix {

hal::Fault Link::Configure(std::string_view uri) {
  const hal::Fault fault = hal::ParseLinkAddress(uri, address_);
  if (!fault.ok()) return fault;
  switch (address_.kind) {
    case hal::LinkAddress::Kind::kUdp:
      link_.emplace<UdpLink>(address_);
      break;
    case hal::LinkAddress::Kind::kTcp:
      link_.emplace<TcpLink>(address_);
      break;
    case hal::LinkAddress::Kind::kSerial:
      link_.emplace<SerialLink>(address_);
      break;
  }
  return fault;
}

hal::ByteLink* Link::get() noexcept {
  return std::visit(
      [](auto& link) -> hal::ByteLink* {
        if constexpr (std::is_same_v<decltype(link), std::monostate&>) {
          return nullptr;
        } else {
          return &link;
        }
      },
      link_);
}

int Link::fd() const noexcept {
  return std::visit(
      [](const auto& link) {
        if constexpr (std::is_same_v<decltype(link), const std::monostate&>) {
          return -1;
        } else {
          return link.fd();
        }
      },
      link_);
}

}  // namespace disflow::posix
