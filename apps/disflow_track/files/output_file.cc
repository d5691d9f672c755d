// SPDX-License-Identifier: BSD-3-Clause
#include "files/output_file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <utility>

#include "output_path.h"
#include "program/exit_status.h"
#include "program/stop_signal.h"

namespace disflow::apps {
namespace {

[[noreturn]] void Fail(const std::string& path, int error) {
  throw Failure(kOutputFailed, path + ": cannot be written: " + std::strerror(error));
}

/// How soon a stop signal is noticed while nobody reads from a pipe.
constexpr int kPipePoll_ms = 50;
/// So many polls in a row may pass after a stop signal until a pipe's reader is given up.
constexpr int kPollsAfterStop = 1000 / kPipePoll_ms;

/// @return The kind of file at a path (S_IFIFO …), following links; 0 if there is none.
mode_t KindOf(const std::string& path) noexcept {
  struct stat info {};
  return ::stat(path.c_str(), &info) == 0 ? info.st_mode & S_IFMT : 0;
}

/// A pipe opens as soon as somebody reads from it. Waiting for that in open() itself would outlast
/// a stop signal, and so would a write() to a pipe that is full.
posix::FileDescriptor OpenPipe(const std::string& path) {
  for (;;) {
    posix::FileDescriptor pipe(posix::RetryOnSignal(
        [&path] { return ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC); }));
    if (pipe.is_open()) return pipe;
    if (errno != ENXIO) Fail(path, errno);
    if (StopRequested()) {
      throw Failure(kOutputFailed, path + ": stopped while waiting for somebody to read this pipe");
    }
    (void)::poll(nullptr, 0, kPipePoll_ms);
  }
}

/// The descriptor of a file that the program was started with, if that is what a path stands for,
/// e.g. /dev/stdout.
std::optional<int> OpenFileAt(const std::string& path) {
  return KindOf(path) == S_IFREG ? DescriptorOf(path) : std::nullopt;
}

posix::FileDescriptor Create(const std::string& path, const std::string& shown_path) {
  if (KindOf(path) == S_IFIFO) return OpenPipe(path);
  // Goes on where whoever started the program has written to: a log keeps what is in it.
  const std::optional<int> open_file = OpenFileAt(path);
  posix::FileDescriptor file(posix::RetryOnSignal([&] {
    return open_file ? ::fcntl(*open_file, F_DUPFD_CLOEXEC, 0)
                     : ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  }));
  if (!file.is_open()) Fail(shown_path, errno);
  return file;
}

/// Waits until a pipe has room again; its reader may take its time unless the program is to stop.
/// @return false if the program is to stop and the reader does not read.
bool AwaitRoom(int fd) noexcept {
  for (int polls_after_stop = 0; polls_after_stop < kPollsAfterStop;) {
    pollfd pipe{.fd = fd, .events = POLLOUT, .revents = 0};
    if (::poll(&pipe, 1, kPipePoll_ms) > 0) return true;
    if (StopRequested()) ++polls_after_stop;
  }
  return false;
}

/// @return 0 or errno; ECANCELED if a pipe's reader was given up.
int WriteAll(int fd, std::string_view bytes) noexcept {
  while (!bytes.empty()) {
    const ssize_t written =
        posix::RetryOnSignal([fd, bytes] { return ::write(fd, bytes.data(), bytes.size()); });
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EAGAIN) {
      return errno;
    } else if (!AwaitRoom(fd)) {
      return ECANCELED;
    }
  }
  return 0;
}

/// @return As WriteAll(); also what some file systems say no sooner than when a file is closed.
int WriteAndClose(posix::FileDescriptor file, std::string_view bytes) noexcept {
  const int error = WriteAll(file.get(), bytes);
  return error == 0 && !file.Close() ? errno : error;
}

}  // namespace

RecordFile::RecordFile(const std::string& path)
    : path_(path), is_own_(!OpenFileAt(path)), file_(Create(path, path)) {}

bool RecordFile::Append(std::string_view record) noexcept {
  if (error_ != 0) return false;
  error_ = WriteAll(file_.get(), record);
  if (error_ == 0) {
    complete_bytes_ += static_cast<std::int64_t>(record.size());
    return true;
  }
  // Pipes and devices cannot be cut; there is nothing to repair then.
  if (is_own_) (void)!::ftruncate(file_.get(), complete_bytes_);
  return false;
}

void ReplaceFile(const std::string& path, std::string_view contents) {
  const std::string target = FollowLinks(path);
  const std::string part = PartPath(target);
  int error = WriteAndClose(Create(part, path), contents);
  if (error == 0 && std::rename(part.c_str(), target.c_str()) != 0) error = errno;
  if (error == 0) return;
  (void)::unlink(part.c_str());
  Fail(path, error);
}

AtomicFile::AtomicFile(const std::string& path) : path_(path) {
  const mode_t kind = KindOf(path);
  if (kind == S_IFDIR) Fail(path, EISDIR);
  if ((kind != 0 && kind != S_IFREG) || OpenFileAt(path)) {
    stream_ = Create(path, path);
    return;
  }
  const std::string part = PartPath(FollowLinks(path));
  (void)Create(part, path);
  (void)::unlink(part.c_str());
}

void AtomicFile::Commit(std::string_view contents) {
  if (!stream_.is_open()) return ReplaceFile(path_, contents);
  const int error = WriteAndClose(std::move(stream_), contents);
  if (error != 0) Fail(path_, error);
}

}  // namespace disflow::apps
