// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/hal/fault.h"

namespace disflow::posix {

/// A Fault for a failed system call: "<name>: <what>: <the system's words>".
/// @param error Value of errno.
[[nodiscard]] hal::Fault ErrnoFault(Status status, const char* name, const char* what,
                                    int error) noexcept;

}  // namespace disflow::posix
