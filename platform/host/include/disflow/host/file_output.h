// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// Says which file cannot be written and, from errno, why.
[[nodiscard]] hal::Fault WriteFault(const std::filesystem::path& file);

/// Creates a file or empties it. @return The descriptor, or -1 and errno.
[[nodiscard]] int CreateFile(const std::filesystem::path& file) noexcept;

/// @return false and errno if not all of it could be written.
[[nodiscard]] bool WriteAll(int fd, std::string_view bytes) noexcept;

/// Creates or replaces a file. @return kIoError, naming it; it is then cut or empty.
[[nodiscard]] hal::Fault WriteWholeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace disflow::host
