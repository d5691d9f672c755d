// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "disflow/hal/fault.h"

namespace disflow::host {

/// A text file that grows by whole lines. Each is handed to the kernel at once, so that whatever
/// ends the program takes none of them away; a line that finds no room is taken back.
class LineFile {
 public:
  LineFile() = default;
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  ~LineFile() { (void)Close(); }

  /// Creates the file or empties it. @return kIoError, naming the file.
  [[nodiscard]] hal::Fault Open(const std::filesystem::path& path);
  [[nodiscard]] bool is_open() const noexcept { return fd_ >= 0; }

  /// @param line Without its line feed.
  /// @return kIoError; the file then ends after the line before.
  [[nodiscard]] hal::Fault Append(std::string_view line);
  /// @return kIoError: what was appended may not be there.
  hal::Fault Close();

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::int64_t whole_bytes_ = 0;
};

}  // namespace disflow::host
