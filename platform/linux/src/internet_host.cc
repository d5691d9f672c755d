// SPDX-License-Identifier: BSD-3-Clause
#include "internet_host.h"

#include <cstdio>

namespace disflow::posix {

std::string NameOfHost(const char* scheme, const hal::LinkAddress& address) {
  const std::string host = address.host;
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return scheme + (is_ipv6 ? "[" + host + "]" : host) + ":" + std::to_string(address.port);
}

hal::Fault ResolveHost(const hal::LinkAddress& address, int socket_type, const char* name,
                       AddressList& list) noexcept {
  char port[8] = {};
  (void)std::snprintf(port, sizeof(port), "%u", unsigned{address.port});
  addrinfo hints{};
  hints.ai_socktype = socket_type;
  hints.ai_flags = AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(address.host, port, &hints, &found);
  if (error != 0) {
    return hal::MakeFault(Status::kNotFound,
                          "%s: host '%s' cannot be found: %s; check the name or use an address",
                          name, address.host, ::gai_strerror(error));
  }
  list.reset(found);
  return {};
}

}  // namespace disflow::posix
