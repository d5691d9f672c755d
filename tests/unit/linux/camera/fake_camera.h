// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <linux/videodev2.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "disflow/posix/camera/video_kernel.h"

namespace disflow::posix {

/// A camera behind the system calls: one device with one stream, whose driver does what a test
/// says. Time stands still but in Wait().
class FakeCamera final : public VideoKernel {
 public:
  struct Format {
    std::uint32_t fourcc;
    std::uint32_t width;
    std::uint32_t height;
    std::uint32_t bytes_per_line;
  };

  // What the device is.
  std::string path = "/dev/video0";
  std::vector<Format> formats{{V4L2_PIX_FMT_Z16, 4, 3, 8}};
  std::uint32_t capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
  std::uint32_t rate_hz = 30;
  std::uint32_t buffer_limit = 16;
  std::uint32_t size_factor = 1;  ///< Of sizeimage, for formats of several planes.
  bool exports_dmabuf = true;
  bool is_there = true;
  std::map<unsigned long, int> failures;  ///< errno of a request.

  // What became of it.
  int open_files = 0;
  int mapped = 0;
  int starts = 0;
  bool streaming = false;

  /// Puts a frame into the oldest queued buffer; a driver without one loses it.
  void Shoot(std::uint16_t pixel, std::uint32_t flags = 0, std::uint32_t missing_bytes = 0) {
    const std::uint32_t sequence = next_sequence++;
    if (queued_.empty()) return;
    const std::uint32_t index = queued_.front();
    queued_.pop_front();
    for (std::size_t i = 0; i + 1 < memory_[index].size(); i += 2) {
      std::memcpy(memory_[index].data() + i, &pixel, 2);
    }
    v4l2_buffer filled{};
    filled.index = index;
    filled.bytesused = static_cast<std::uint32_t>(memory_[index].size()) - missing_bytes;
    filled.flags = flags | stamp_flags;
    filled.sequence = sequence;
    filled.timestamp.tv_sec = static_cast<time_t>(now_ns / 1'000'000'000);
    filled.timestamp.tv_usec = static_cast<suseconds_t>(now_ns % 1'000'000'000 / 1000);
    filled_.push_back(filled);
  }
  std::uint32_t next_sequence = 0;
  std::uint32_t stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  std::int64_t now_ns = 1'000'000'000;

  [[nodiscard]] std::size_t queued() const { return queued_.size(); }

  void Unplug() { is_there = false; }
  void PlugIn() {
    is_there = true;
    next_sequence = 0;
  }

 private:
  int Open(const char* wanted) noexcept override {
    if (!is_there || path != wanted) return Fail(ENOENT);
    if (Fails(1)) return -1;
    ++open_files;
    return 3;
  }
  void Close(int fd) noexcept override {
    if (fd == 3) {
      --open_files;
    } else {
      --open_dmabufs;
    }
  }
  void* Map(int, std::size_t, std::uint32_t offset) noexcept override {
    ++mapped;
    return memory_[offset].data();
  }
  void Unmap(void*, std::size_t) noexcept override { --mapped; }
  bool Wait(int, std::int64_t timeout_ns) noexcept override {
    if (!filled_.empty() || !is_there) return true;
    now_ns += timeout_ns;
    errno = 0;
    return false;
  }
  std::int64_t NowNs() noexcept override { return now_ns; }

  int Ioctl(int, unsigned long request, void* argument) noexcept override {
    if (!is_there) return Fail(ENODEV);
    if (Fails(request)) return -1;
    switch (request) {
      case VIDIOC_QUERYCAP: {
        auto& capability = *static_cast<v4l2_capability*>(argument);
        capability.capabilities = capabilities | V4L2_CAP_DEVICE_CAPS;
        capability.device_caps = capabilities;
        return 0;
      }
      case VIDIOC_ENUM_FMT: {
        auto& entry = *static_cast<v4l2_fmtdesc*>(argument);
        if (entry.index >= formats.size()) return Fail(EINVAL);
        entry.pixelformat = formats[entry.index].fourcc;
        return 0;
      }
      case VIDIOC_ENUM_FRAMESIZES: {
        auto& entry = *static_cast<v4l2_frmsizeenum*>(argument);
        if (entry.index > 0) return Fail(EINVAL);
        entry.type = V4L2_FRMSIZE_TYPE_DISCRETE;
        entry.discrete = {Find(entry.pixel_format).width, Find(entry.pixel_format).height};
        return 0;
      }
      case VIDIOC_ENUM_FRAMEINTERVALS: {
        auto& entry = *static_cast<v4l2_frmivalenum*>(argument);
        if (entry.index > 0) return Fail(EINVAL);
        entry.type = V4L2_FRMIVAL_TYPE_DISCRETE;
        entry.discrete = {1, rate_hz};
        return 0;
      }
      case VIDIOC_S_FMT:
        current_ = Find(static_cast<v4l2_format*>(argument)->fmt.pix.pixelformat);
        return 0;
      case VIDIOC_G_FMT: {
        v4l2_pix_format& pixels = static_cast<v4l2_format*>(argument)->fmt.pix;
        pixels.pixelformat = current_.fourcc;
        pixels.width = current_.width;
        pixels.height = current_.height;
        pixels.bytesperline = current_.bytes_per_line;
        pixels.sizeimage = current_.bytes_per_line * current_.height * size_factor;
        pixels.field = V4L2_FIELD_NONE;
        return 0;
      }
      case VIDIOC_S_PARM:
      case VIDIOC_G_PARM:
        static_cast<v4l2_streamparm*>(argument)->parm.capture.timeperframe = {1, rate_hz};
        return 0;
      case VIDIOC_REQBUFS: {
        auto& buffers = *static_cast<v4l2_requestbuffers*>(argument);
        buffers.count = std::min(buffers.count, buffer_limit);
        memory_.assign(buffers.count, std::vector<char>(std::size_t{current_.bytes_per_line} *
                                                        current_.height * size_factor));
        return 0;
      }
      case VIDIOC_QUERYBUF: {
        auto& buffer = *static_cast<v4l2_buffer*>(argument);
        buffer.length = static_cast<std::uint32_t>(memory_[buffer.index].size());
        buffer.m.offset = buffer.index;
        return 0;
      }
      case VIDIOC_EXPBUF: {
        if (!exports_dmabuf) return Fail(ENOTTY);
        auto& buffer = *static_cast<v4l2_exportbuffer*>(argument);
        buffer.fd = 100 + static_cast<int>(buffer.index);
        ++open_dmabufs;
        return 0;
      }
      case VIDIOC_QBUF:
        queued_.push_back(static_cast<v4l2_buffer*>(argument)->index);
        return 0;
      case VIDIOC_DQBUF:
        if (filled_.empty()) return Fail(EAGAIN);
        *static_cast<v4l2_buffer*>(argument) = filled_.front();
        filled_.pop_front();
        return 0;
      case VIDIOC_STREAMON:
        streaming = true;
        ++starts;
        return 0;
      case VIDIOC_STREAMOFF:
        streaming = false;
        queued_.clear();
        filled_.clear();
        return 0;
      default:
        return Fail(ENOTTY);
    }
  }

  Format Find(std::uint32_t fourcc) const {
    for (const Format& format : formats) {
      if (format.fourcc == fourcc) return format;
    }
    return formats.front();  // as real drivers do
  }
  bool Fails(unsigned long request) {
    const auto failure = failures.find(request);
    if (failure == failures.end()) return false;
    errno = failure->second;
    return true;
  }
  static int Fail(int error) {
    errno = error;
    return -1;
  }

 public:
  static constexpr unsigned long kOpen = 1;  ///< For `failures`.
  int open_dmabufs = 0;

 private:
  Format current_{};
  std::vector<std::vector<char>> memory_;
  std::deque<std::uint32_t> queued_;
  std::deque<v4l2_buffer> filled_;
};

}  // namespace disflow::posix
