// SPDX-License-Identifier: BSD-3-Clause
#include "faulty_disk.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdarg>

namespace disflow::test {
namespace {

void Kill() { (void)::raise(SIGKILL); }

bool IsFull() { return disk.room_bytes == 0 || disk.room_calls == 0; }

int NoSpaceLeft() {
  errno = ENOSPC;
  return -1;
}

/// @param write Writes as many bytes as it is given.
template <class Write>
ssize_t WriteWhatFits(std::size_t size, Write&& write) {
  const bool is_full = disk.room_calls == 0 && disk.end != DiskEnd::kKilled;
  const auto room = is_full ? 0 : static_cast<std::size_t>(disk.room_bytes);
  const std::size_t fits = std::min(size, room);
  const ssize_t written = fits > 0 || size == 0 ? write(fits) : 0;
  if (written < 0) return written;
  if (disk.room_bytes != FaultyDisk::kEndless) disk.room_bytes -= written;
  disk.written_bytes += written;
  if (disk.end == DiskEnd::kKilledBefore && disk.room_bytes == 0) Kill();
  if (disk.end == DiskEnd::kKilled && fits < size) Kill();
  disk.writes.push_back(static_cast<std::size_t>(written));
  return written > 0 || size == 0 ? written : NoSpaceLeft();
}

/// Before a call that makes or closes something. @return Whether it may succeed.
bool AllowCall() {
  if (disk.end == DiskEnd::kKilled && disk.room_calls == 0) Kill();
  if (disk.end == DiskEnd::kFullForAll && IsFull()) return false;
  ++disk.calls;
  if (disk.room_calls != FaultyDisk::kEndless && disk.room_calls > 0) --disk.room_calls;
  return true;
}

}  // namespace
}  // namespace disflow::test

namespace test = disflow::test;

// NOLINTBEGIN(bugprone-reserved-identifier): the linker's names
extern "C" {

ssize_t __real_write(int fd, const void* bytes, std::size_t size);
ssize_t __real_pwrite(int fd, const void* bytes, std::size_t size, off_t at);
int __real_open(const char* path, int flags, ...);
int __real_close(int fd);
int __real_ftruncate(int fd, off_t size);

ssize_t __wrap_write(int fd, const void* bytes, std::size_t size);
ssize_t __wrap_pwrite(int fd, const void* bytes, std::size_t size, off_t at);
int __wrap_open(const char* path, int flags, ...);
int __wrap_close(int fd);
int __wrap_ftruncate(int fd, off_t size);

ssize_t __wrap_write(int fd, const void* bytes, std::size_t size) {
  return test::WriteWhatFits(size, [&](std::size_t fits) { return __real_write(fd, bytes, fits); });
}

ssize_t __wrap_pwrite(int fd, const void* bytes, std::size_t size, off_t at) {
  return test::WriteWhatFits(size,
                             [&](std::size_t fits) { return __real_pwrite(fd, bytes, fits, at); });
}

int __wrap_open(const char* path, int flags, ...) {
  if ((flags & O_CREAT) == 0) return __real_open(path, flags);
  std::va_list arguments;
  va_start(arguments, flags);
  const auto mode = va_arg(arguments, unsigned);
  va_end(arguments);
  return test::AllowCall() ? __real_open(path, flags, mode) : test::NoSpaceLeft();
}

int __wrap_close(int fd) {
  const bool allowed = test::AllowCall();
  // Closed it is all the same.
  const int result = __real_close(fd);
  return allowed && test::disk.can_close ? result : test::NoSpaceLeft();
}

int __wrap_ftruncate(int fd, off_t size) {
  return test::disk.can_cut ? __real_ftruncate(fd, size) : test::NoSpaceLeft();
}

/// The standard library's, where no option of the linker reaches: a program's own function comes
/// before that of the C library.
int mkdir(const char* path, mode_t mode) noexcept {
  return test::AllowCall() ? ::mkdirat(AT_FDCWD, path, mode) : test::NoSpaceLeft();
}

}  // extern "C"
// NOLINTEND(bugprone-reserved-identifier)
