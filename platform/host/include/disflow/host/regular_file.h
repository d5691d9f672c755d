// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// For files of a recording, before they are opened: opening a pipe waits for somebody who writes
/// into it, perhaps for ever, and devices have no end.
/// @return kOk also for what is not there, which opening it says; kCorrupt, naming the file, if it
/// is a folder, a pipe, a socket or a device.
[[nodiscard]] hal::Fault CheckRegularFile(const std::filesystem::path& file);

}  // namespace disflow::host
