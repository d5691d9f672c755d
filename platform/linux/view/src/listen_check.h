// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/posix/view/web_address.h"

namespace disflow::posix {

/// Tries whether an address can be listened on, since libwebsockets does not tell what keeps it
/// from it.
/// @return kBusy, kPermissionDenied, kNotFound, kIoError.
[[nodiscard]] hal::Fault CheckListening(const WebAddress& address);

/// Whether the program may have as many files open as a server needs: with fewer libwebsockets
/// listens to nothing, or turns round and round over connections that it cannot accept.
/// @param needed Connections and what the server itself opens.
/// @return kIoError.
[[nodiscard]] hal::Fault CheckDescriptors(const WebAddress& address, unsigned needed);

}  // namespace disflow::posix
