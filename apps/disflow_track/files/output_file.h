// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "disflow/posix/file_descriptor.h"

namespace disflow::apps {

/// A file that grows by whole records: when the disk is full it ends after the last complete one.
/// Opening a pipe waits until somebody reads from it; a stop signal ends that, and gives up a
/// reader that does not read.
class RecordFile {
 public:
  /// Creates the file or empties it. @throws Failure kOutputFailed.
  explicit RecordFile(const std::string& path);

  /// @return false if this or an earlier record could not be written; error() says why.
  [[nodiscard]] bool Append(std::string_view record) noexcept;
  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  /// @return errno of the first failure, 0 if there was none.
  [[nodiscard]] int error() const noexcept { return error_; }

 private:
  std::string path_;
  posix::FileDescriptor file_;
  std::int64_t complete_bytes_ = 0;
  int error_ = 0;
};

/// Where an AtomicFile is written until it is committed.
[[nodiscard]] inline std::string PartPath(const std::string& path) { return path + ".part"; }

/// A file that appears, whole, only when it is committed; what stood at the path before stays until
/// then.
class AtomicFile {
 public:
  /// Makes sure that the file can be written. @throws Failure kOutputFailed.
  explicit AtomicFile(const std::string& path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();

  /// @throws Failure kOutputFailed.
  void Commit(std::string_view contents);

 private:
  std::string path_;
  std::string part_path_;  ///< Empty where the path is a device or pipe.
  posix::FileDescriptor file_;
};

}  // namespace disflow::apps
