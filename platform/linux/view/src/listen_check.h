// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/posix/view/web_address.h"

namespace disflow::posix {

/// Tries whether an address can be listened on, since libwebsockets does not tell what keeps it
/// from it.
/// @return kBusy, kPermissionDenied, kNotFound, kIoError.
[[nodiscard]] hal::Fault CheckListening(const WebAddress& address);

}  // namespace disflow::posix
