// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>

#include "disflow/hal/fault.h"
#include "disflow/posix/camera/depth_pixel_format.h"
#include "disflow/posix/camera/video_kernel.h"

namespace disflow::posix {

/// What is asked of a V4L2 device; zeros and null mean "as the driver likes".
struct StreamRequest {
  const DepthPixelFormat* format = nullptr;
  int width_px = 0;
  int height_px = 0;
  float rate_hz = 0.0F;
};

/// What the driver does, as it says itself.
struct StreamLayout {
  const DepthPixelFormat* format = nullptr;
  int width_px = 0;
  int height_px = 0;
  float rate_hz = 0.0F;          ///< 0 = the driver does not say.
  std::size_t stride_bytes = 0;  ///< Of the depth image.
  std::size_t offset_bytes = 0;  ///< From the buffer's start to the depth image.
  std::size_t image_bytes = 0;   ///< A frame with fewer is cut.
};

/// Checks that the device captures single-planar video by streaming.
/// @param name For messages.
/// @return kUnsupported with the reason, kDeviceLost, kIoError.
[[nodiscard]] hal::Fault CheckCapabilities(VideoKernel& kernel, int fd, const char* name) noexcept;

/// Sets format, size and rate and reads back what the driver made of it. Nothing is taken
/// silently: what differs from the request is refused.
/// @param layout Unchanged unless the result is ok.
/// @return kUnsupported with what the device offers instead, kBusy, kDeviceLost, kIoError.
[[nodiscard]] hal::Fault NegotiateStream(VideoKernel& kernel, int fd, const char* name,
                                         const StreamRequest& request,
                                         StreamLayout& layout) noexcept;

/// @return true if the device delivers the format; any depth format if it is null.
[[nodiscard]] bool OffersFormat(VideoKernel& kernel, int fd,
                                const DepthPixelFormat* format) noexcept;

/// A Fault for a system call that failed while talking to a camera.
/// @param error Value of errno.
[[nodiscard]] hal::Fault VideoFault(const char* name, const char* what, int error) noexcept;

}  // namespace disflow::posix
