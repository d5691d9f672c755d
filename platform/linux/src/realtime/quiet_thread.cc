// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/quiet_thread.h"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <utility>

namespace disflow::posix {

std::thread StartQuietThread(std::function<void()> work) {
  sigset_t all;
  sigset_t before;
  (void)sigfillset(&all);
  (void)pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread([work = std::move(work)] {
    constexpr int kNiceness = 10;
    // On Linux this is of the calling thread alone. If it is refused, the thread competes like any
    // other.
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
    work();
  });
  (void)pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace disflow::posix
