// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/video_kernel.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <limits>

#include "disflow/posix/file_descriptor.h"
#include "disflow/posix/monotonic_clock.h"

namespace disflow::posix {
namespace {

constexpr std::int64_t kNsPerMs = 1'000'000;

class SystemCalls final : public VideoKernel {
 public:
  int Open(const char* path) noexcept override {
    return RetryOnSignal([path] { return ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC); });
  }
  void Close(int fd) noexcept override { (void)::close(fd); }
  int Ioctl(int fd, unsigned long request, void* argument) noexcept override {
    return RetryOnSignal([=] { return ::ioctl(fd, request, argument); });
  }
  void* Map(int fd, std::size_t length, std::uint32_t offset) noexcept override {
    // Some drivers refuse to map for reading only.
    void* const memory = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, fd, offset);
    return memory == MAP_FAILED ? nullptr : memory;
  }
  void Unmap(void* memory, std::size_t length) noexcept override { (void)::munmap(memory, length); }
  bool Wait(int fd, std::int64_t timeout_ns) noexcept override {
    pollfd entry{fd, POLLIN, 0};
    const std::int64_t timeout_ms =
        (std::max<std::int64_t>(timeout_ns, 0) + kNsPerMs - 1) / kNsPerMs;
    // A signal may be the one that ends the program: the caller is to see it.
    return ::poll(&entry, 1,
                  static_cast<int>(
                      std::min<std::int64_t>(timeout_ms, std::numeric_limits<int>::max()))) > 0;
  }
  std::int64_t NowNs() noexcept override {
    MonotonicClock clock;
    return clock.NowNs();
  }
};

}  // namespace

VideoKernel& LinuxVideoKernel() noexcept {
  static SystemCalls system_calls;
  return system_calls;
}

}  // namespace disflow::posix
