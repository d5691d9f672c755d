// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <linux/videodev2.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "disflow/hal/fault.h"
#include "disflow/posix/camera/video_kernel.h"

namespace disflow::posix {

/// The driver's buffers, mapped into the program, and the stream that fills them.
class V4l2Buffers {
 public:
  static constexpr std::uint32_t kWanted = 6;
  static constexpr std::uint32_t kNeeded = 4;
  static constexpr std::uint32_t kMost = 32;  ///< V4L2's own limit.

  explicit V4l2Buffers(VideoKernel& kernel) noexcept : kernel_(kernel) {}
  V4l2Buffers(const V4l2Buffers&) = delete;
  V4l2Buffers& operator=(const V4l2Buffers&) = delete;

  /// @param name For messages; outlives this or the next call.
  void set_name(const char* name) noexcept { name_ = name; }

  /// Asks for buffers of at least `min_bytes`, maps all and exports them as DMABUF where the
  /// driver can.
  [[nodiscard]] hal::Fault Acquire(int fd, std::size_t min_bytes) noexcept;
  /// Gives all to the driver and starts the stream.
  [[nodiscard]] hal::Fault Start() noexcept;
  void Stop() noexcept;
  /// Stops and gives everything back.
  void Release() noexcept;

  /// @return 0, or errno; EAGAIN = no filled buffer there.
  [[nodiscard]] int Dequeue(v4l2_buffer& buffer) noexcept;
  /// @return 0, or errno.
  [[nodiscard]] int Enqueue(std::uint32_t index) noexcept;

  [[nodiscard]] const std::byte* data(std::uint32_t index) const noexcept {
    return static_cast<const std::byte*>(buffers_[index].memory);
  }
  [[nodiscard]] std::size_t size(std::uint32_t index) const noexcept {
    return buffers_[index].length;
  }
  /// @return The buffer's DMABUF, owned by this; -1 if the driver offers none.
  [[nodiscard]] int dmabuf(std::uint32_t index) const noexcept { return buffers_[index].dmabuf; }
  [[nodiscard]] std::uint32_t count() const noexcept { return count_; }

 private:
  struct Buffer {
    void* memory = nullptr;
    std::size_t length = 0;
    int dmabuf = -1;
  };

  [[nodiscard]] hal::Fault Map(std::uint32_t index, std::size_t min_bytes) noexcept;
  void Export(std::uint32_t index) noexcept;

  VideoKernel& kernel_;
  const char* name_ = "";
  int fd_ = -1;
  std::uint32_t count_ = 0;
  std::array<Buffer, kMost> buffers_{};
};

}  // namespace disflow::posix
