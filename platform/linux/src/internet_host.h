// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <netdb.h>

#include <memory>
#include <string>

#include "disflow/hal/fault.h"
#include "disflow/hal/link_address.h"

namespace disflow::posix {

using AddressList = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

/// @param scheme As "udp://".
/// @return The host and port of an address as a person writes them.
[[nodiscard]] std::string NameOfHost(const char* scheme, const hal::LinkAddress& address);

/// Looks the host up, which may wait for a name server.
/// @param socket_type SOCK_DGRAM or SOCK_STREAM.
/// @param name Of the link, for messages.
/// @param list Its addresses.
/// @return kOk or kNotFound.
[[nodiscard]] hal::Fault ResolveHost(const hal::LinkAddress& address, int socket_type,
                                     const char* name, AddressList& list) noexcept;

}  // namespace disflow::posix
