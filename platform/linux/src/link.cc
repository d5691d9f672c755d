// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/link.h"

namespace disflow::posix {

hal::Fault Link::Configure(std::string_view uri) {
  hal::LinkAddress address;
  const hal::Fault fault = hal::ParseLinkAddress(uri, address);
  if (!fault.ok()) return fault;
  key_file_ = address.key_file;
  may_choose_ = address.may_choose;
  switch (address.kind) {
    case hal::LinkAddress::Kind::kUdp:
      link_.emplace<UdpLink>(address);
      break;
    case hal::LinkAddress::Kind::kSerial:
      link_.emplace<SerialLink>(address);
      break;
  }
  return fault;
}

hal::ByteLink* Link::get() noexcept {
  if (auto* const udp = std::get_if<UdpLink>(&link_)) return udp;
  return std::get_if<SerialLink>(&link_);
}

}  // namespace disflow::posix
