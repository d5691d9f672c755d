// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

[[noreturn]] void Fail(const std::string& path, int error) {
  throw Failure(kOutputFailed, path + ": cannot be written: " + std::strerror(error));
}

posix::FileDescriptor Create(const std::string& path, const std::string& shown_path) {
  posix::FileDescriptor file(posix::RetryOnSignal(
      [&path] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666); }));
  if (!file.is_open()) Fail(shown_path, errno);
  return file;
}

/// @return 0 or errno.
int WriteAll(int fd, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written =
        posix::RetryOnSignal([fd, bytes] { return ::write(fd, bytes.data(), bytes.size()); });
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

bool IsDeviceOrPipe(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

bool IsFolder(const std::string& path) {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode);
}

}  // namespace

RecordFile::RecordFile(const std::string& path) : path_(path), file_(Create(path, path)) {}

bool RecordFile::Append(std::string_view record) noexcept {
  if (error_ != 0) return false;
  error_ = WriteAll(file_.get(), record);
  if (error_ == 0) {
    complete_bytes_ += static_cast<std::int64_t>(record.size());
    return true;
  }
  // Pipes and devices cannot be cut; there is nothing to repair then.
  (void)!::ftruncate(file_.get(), complete_bytes_);
  return false;
}

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  if (IsFolder(path)) Fail(path, EISDIR);
  if (!IsDeviceOrPipe(path)) part_path_ = path + ".part";
  file_ = Create(part_path_.empty() ? path_ : part_path_, path_);
}

AtomicFile::~AtomicFile() {
  if (file_.is_open() && !part_path_.empty()) (void)::unlink(part_path_.c_str());
}

void AtomicFile::Commit(std::string_view contents) {
  int error = WriteAll(file_.get(), contents);
  if (error == 0 && !part_path_.empty() && std::rename(part_path_.c_str(), path_.c_str()) != 0) {
    error = errno;
  }
  if (error != 0) Fail(path_, error);
  file_.Reset();
}

}  // namespace disflow::apps
