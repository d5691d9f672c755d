// SPDX-License-Identifier: BSD-3-Clause
#include "v4l2_buffers.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>

#include "v4l2_format.h"

namespace disflow::posix {
namespace {

using hal::Fault;

constexpr std::uint32_t kType = V4L2_BUF_TYPE_VIDEO_CAPTURE;

v4l2_buffer Describe(std::uint32_t index) noexcept {
  v4l2_buffer buffer{};
  buffer.type = kType;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

}  // namespace

Fault V4l2Buffers::Acquire(int fd, std::size_t min_bytes) noexcept {
  fd_ = fd;
  v4l2_requestbuffers request{};
  request.count = kWanted;
  request.type = kType;
  request.memory = V4L2_MEMORY_MMAP;
  if (kernel_.Ioctl(fd_, VIDIOC_REQBUFS, &request) != 0) {
    return VideoFault(name_, "cannot get buffers", errno);
  }
  const std::uint32_t given = std::min(request.count, kMost);
  for (std::uint32_t i = 0; i < given; ++i) {
    const Fault fault = Map(i, min_bytes);
    if (!fault.ok()) return fault;
  }
  if (given < kNeeded) {
    return hal::MakeFault(Status::kUnsupported, "%s: its driver gives %u buffers; %u are needed",
                          name_, given, kNeeded);
  }
  return {};
}

Fault V4l2Buffers::Map(std::uint32_t index, std::size_t min_bytes) noexcept {
  v4l2_buffer description = Describe(index);
  if (kernel_.Ioctl(fd_, VIDIOC_QUERYBUF, &description) != 0) {
    return VideoFault(name_, "cannot ask for a buffer", errno);
  }
  if (description.length < min_bytes) {
    return hal::MakeFault(Status::kUnsupported, "%s: its buffers of %u bytes are too small for %zu",
                          name_, description.length, min_bytes);
  }
  void* const memory = kernel_.Map(fd_, description.length, description.m.offset);
  if (memory == nullptr) return VideoFault(name_, "cannot map a buffer", errno);
  buffers_[index] = {memory, description.length, -1};
  count_ = index + 1;
  Export(index);
  return {};
}

void V4l2Buffers::Export(std::uint32_t index) noexcept {
  v4l2_exportbuffer request{};
  request.type = kType;
  request.index = index;
  request.flags = O_RDONLY | O_CLOEXEC;
  // Not every driver can; then there is only the mapping.
  if (kernel_.Ioctl(fd_, VIDIOC_EXPBUF, &request) == 0) buffers_[index].dmabuf = request.fd;
}

Fault V4l2Buffers::Start() noexcept {
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (const int error = Enqueue(i); error != 0) {
      return VideoFault(name_, "cannot queue a buffer", error);
    }
  }
  std::uint32_t type = kType;
  if (kernel_.Ioctl(fd_, VIDIOC_STREAMON, &type) != 0) {
    return VideoFault(name_, "cannot start the stream", errno);
  }
  return {};
}

void V4l2Buffers::Stop() noexcept {
  // Also after a failed start: takes back the buffers that were queued. A camera that is gone
  // cannot be stopped.
  std::uint32_t type = kType;
  if (count_ > 0) (void)kernel_.Ioctl(fd_, VIDIOC_STREAMOFF, &type);
}

void V4l2Buffers::Release() noexcept {
  Stop();
  for (std::uint32_t i = 0; i < count_; ++i) {
    if (buffers_[i].dmabuf >= 0) kernel_.Close(buffers_[i].dmabuf);
    kernel_.Unmap(buffers_[i].memory, buffers_[i].length);
    buffers_[i] = {};
  }
  count_ = 0;
  fd_ = -1;
}

int V4l2Buffers::Dequeue(v4l2_buffer& buffer) noexcept {
  buffer = Describe(0);
  if (kernel_.Ioctl(fd_, VIDIOC_DQBUF, &buffer) != 0) return errno;
  // A bogus index must not reach beyond the table.
  return buffer.index < count_ ? 0 : EIO;
}

int V4l2Buffers::Enqueue(std::uint32_t index) noexcept {
  v4l2_buffer buffer = Describe(index);
  return kernel_.Ioctl(fd_, VIDIOC_QBUF, &buffer) == 0 ? 0 : errno;
}

}  // namespace disflow::posix
