// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/realtime.h"

#include <sched.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstddef>
#include <cstring>

namespace disflow::posix {
namespace {

constexpr std::size_t kStackBytes = 256U * 1024U;
constexpr std::size_t kPageBytes = 4096;

}  // namespace

hal::Fault PinThisThread(int cpu) noexcept {
  if (cpu < 0 || cpu >= CPU_SETSIZE) {
    return hal::MakeFault(Status::kNotFound, "processor %d: there are at most %d", cpu,
                          CPU_SETSIZE);
  }
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<unsigned>(cpu), &set);
  if (::sched_setaffinity(0, sizeof(set), &set) == 0) return {};
  if (errno == EPERM) {
    return hal::MakeFault(Status::kPermissionDenied, "processor %d: the system refuses it", cpu);
  }
  return hal::MakeFault(Status::kNotFound,
                        "processor %d: there is none of that number that this process may use; "
                        "'nproc' and 'taskset -p $$' show which there are",
                        cpu);
}

hal::Fault SetThisThreadPriority(int priority) noexcept {
  sched_param parameters{};
  parameters.sched_priority = priority;
  // Threads and programs that this one starts shall not inherit it.
  if (::sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0) return {};
  if (errno == EPERM) {
    return hal::MakeFault(Status::kPermissionDenied,
                          "real-time priority %d is refused; grant it by LimitRTPRIO=%d in the "
                          "systemd unit, by 'ulimit -r' or CAP_SYS_NICE",
                          priority, priority);
  }
  return hal::MakeFault(Status::kUnsupported, "real-time priority %d: %s", priority,
                        std::strerror(errno));
}

hal::Fault LockMemory() noexcept {
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    if (errno == EPERM || errno == ENOMEM) {
      return hal::MakeFault(Status::kPermissionDenied,
                            "memory cannot be locked; grant it by LimitMEMLOCK=infinity in the "
                            "systemd unit, by 'ulimit -l' or CAP_IPC_LOCK");
    }
    return hal::MakeFault(Status::kIoError, "memory cannot be locked: %s", std::strerror(errno));
  }
  PrefaultStack();
  return {};
}

void PrefaultStack() noexcept {
  [[maybe_unused]] volatile std::byte pages[kStackBytes];
  for (std::size_t i = 0; i < kStackBytes; i += kPageBytes) pages[i] = std::byte{1};
}

}  // namespace disflow::posix
