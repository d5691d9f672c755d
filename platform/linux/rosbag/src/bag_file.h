// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "disflow/hal/fault.h"
#include "disflow/posix/file_descriptor.h"

namespace disflow::posix {

/// A file that is read at any place.
class BagFile {
 public:
  [[nodiscard]] hal::Fault Open(const std::filesystem::path& path);
  /// @return kIoError; also if the file has become shorter meanwhile.
  [[nodiscard]] hal::Fault Read(std::uint64_t begin, std::span<std::uint8_t> bytes) const;
  [[nodiscard]] std::uint64_t size() const noexcept { return size_; }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  /// kCorrupt, naming the file and the place.
  [[nodiscard]] hal::Fault Corrupt(std::uint64_t begin, const char* problem) const;
  [[nodiscard]] hal::Fault IsOver() const;
  /// That it is played although its recorder was killed.
  [[nodiscard]] std::string CutShort() const;

 private:
  std::filesystem::path path_;
  FileDescriptor descriptor_;
  std::uint64_t size_ = 0;
};

}  // namespace disflow::posix
