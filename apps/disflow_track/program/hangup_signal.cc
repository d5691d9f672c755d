// SPDX-License-Identifier: BSD-3-Clause
#include "program/hangup_signal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>

#include "program/stop_signal.h"

namespace disflow::apps {
namespace {

/// What a signal handler can write to; -1: nobody waits.
volatile std::sig_atomic_t told_fd = -1;

void Raise(int fd) noexcept {
  const std::uint64_t one = 1;
  (void)!::write(fd, &one, sizeof(one));
}

extern "C" void OnHangup(int) {
  const int saved = errno;
  if (told_fd >= 0) Raise(told_fd);
  errno = saved;
}

/// Whether this process belongs to a terminal that is there.
bool HasTerminal() noexcept {
  return posix::FileDescriptor(::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)).is_open();
}

}  // namespace

HangupSignal::HangupSignal() noexcept
    : told_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      end_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      had_terminal_(HasTerminal()) {
  told_fd = told_.get();
  struct sigaction action {};
  action.sa_handler = OnHangup;
  action.sa_flags = SA_RESTART;
  (void)::sigaction(SIGHUP, &action, nullptr);
}

HangupSignal::~HangupSignal() {
  InstallStopSignals();
  told_fd = -1;
}

bool HangupSignal::Wait() noexcept {
  for (;;) {
    std::array<pollfd, 2> waited = {{{.fd = told_.get(), .events = POLLIN, .revents = 0},
                                     {.fd = end_.get(), .events = POLLIN, .revents = 0}}};
    if (::poll(waited.data(), waited.size(), -1) < 0 && errno != EINTR) return false;
    if (waited[1].revents != 0) return false;
    std::uint64_t count = 0;
    if (::read(told_.get(), &count, sizeof(count)) != sizeof(count)) continue;
    if (!had_terminal_ || HasTerminal()) return true;
    (void)::kill(::getpid(), SIGTERM);
  }
}

void HangupSignal::End() noexcept { Raise(end_.get()); }

}  // namespace disflow::apps
