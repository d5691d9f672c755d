// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

namespace disflow::posix {

/// The system calls of a camera, so that tests can put a camera of their own behind them. All
/// repeat themselves after a signal and report failures in errno.
class VideoKernel {
 public:
  VideoKernel(const VideoKernel&) = delete;
  VideoKernel& operator=(const VideoKernel&) = delete;

  /// @return Descriptor, non-blocking; -1 on failure.
  [[nodiscard]] virtual int Open(const char* path) noexcept = 0;
  virtual void Close(int fd) noexcept = 0;
  /// @return As ioctl().
  [[nodiscard]] virtual int Ioctl(int fd, unsigned long request, void* argument) noexcept = 0;
  /// @return Null on failure.
  [[nodiscard]] virtual void* Map(int fd, std::size_t length, std::uint32_t offset) noexcept = 0;
  virtual void Unmap(void* memory, std::size_t length) noexcept = 0;
  /// Waits until a frame can be taken or something is wrong. @return false if neither came in time.
  [[nodiscard]] virtual bool Wait(int fd, std::int64_t timeout_ns) noexcept = 0;
  /// CLOCK_MONOTONIC.
  [[nodiscard]] virtual std::int64_t NowNs() noexcept = 0;

 protected:
  VideoKernel() = default;
  ~VideoKernel() = default;  // see hal::DepthSensor
};

/// The running system's; without state.
[[nodiscard]] VideoKernel& LinuxVideoKernel() noexcept;

}  // namespace disflow::posix
