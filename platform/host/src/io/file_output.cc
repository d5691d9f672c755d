// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/file_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace disflow::host {

namespace fs = std::filesystem;

hal::Fault WriteFault(const fs::path& file) {
  const int error = errno;
  const Status status = error == EACCES   ? Status::kPermissionDenied
                        : error == ENOENT ? Status::kNotFound
                                          : Status::kIoError;
  return hal::MakeFault(status, "%s: cannot be written: %s", file.c_str(), std::strerror(error));
}

int CreateFile(const fs::path& file) noexcept {
  int fd = -1;
  do {
    fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  } while (fd < 0 && errno == EINTR);
  return fd;
}

bool WriteAll(int fd, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

hal::Fault WriteWholeFile(const fs::path& file, std::string_view bytes) {
  const int fd = CreateFile(file);
  if (fd < 0) return WriteFault(file);
  const hal::Fault fault = WriteAll(fd, bytes) ? hal::Fault{} : WriteFault(file);
  // Some file systems say only now that there is no room.
  const bool closed = ::close(fd) == 0;
  return fault.ok() && !closed ? WriteFault(file) : fault;
}

}  // namespace disflow::host
