// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "disflow/hal/fault.h"
#include "disflow/hal/mavlink/signing_session.h"

namespace disflow::posix {

/// Reads a key: a file of exactly 32 bytes, or of 64 hex digits with or without a line's end. Only
/// its owner may have access to it.
/// @param key Unchanged unless the result is ok.
/// @return kNotFound, kPermissionDenied, kUnsupported (no ordinary file), kCorrupt (no key in it)
/// or kIoError, naming the file.
[[nodiscard]] hal::Fault ReadSigningKey(const std::string& path, hal::mavlink::SigningKey& key);

}  // namespace disflow::posix
