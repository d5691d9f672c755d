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
  /// Of whole records.
  [[nodiscard]] std::int64_t size_bytes() const noexcept { return complete_bytes_; }

 private:
  std::string path_;
  bool is_own_;  ///< Not one that others write to as well.
  posix::FileDescriptor file_;
  std::int64_t complete_bytes_ = 0;
  int error_ = 0;
};

/// Where an AtomicFile is written while it is committed.
[[nodiscard]] inline std::string PartPath(const std::string& path) { return path + ".part"; }

/// Makes or replaces a regular file, of a link the one that it leads to; it appears, whole, or not
/// at all.
/// @throws Failure kOutputFailed; nothing is left behind then.
void ReplaceFile(const std::string& path, std::string_view contents);

/// A file that appears, whole, only when it is committed; what stood at the path before stays until
/// then. It has no part on disk before that: whatever ends the run leaves nothing behind, unless it
/// strikes while the file is committed. The next one at the same path takes that over.
class AtomicFile {
 public:
  /// Makes sure that the file can be written. @throws Failure kOutputFailed.
  explicit AtomicFile(const std::string& path);

  /// @throws Failure kOutputFailed; nothing is left behind then.
  void Commit(std::string_view contents);

 private:
  std::string path_;
  /// Open if the path is a device, a pipe or standard output, which have no part.
  posix::FileDescriptor stream_;
};

}  // namespace disflow::apps
