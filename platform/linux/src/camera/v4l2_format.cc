// SPDX-License-Identifier: BSD-3-Clause
#include "v4l2_format.h"

#include <linux/videodev2.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "errno_fault.h"
#include "v4l2_offers.h"

namespace disflow::posix {
namespace {

using hal::Fault;
using hal::MakeFault;

constexpr float kRateTolerance = 0.02F;

Fault ChooseFormat(VideoKernel& kernel, int fd, const char* name, const StreamRequest& request,
                   const DepthPixelFormat*& format) noexcept {
  if (request.format != nullptr) {
    format = request.format;
    if (OffersFormat(kernel, fd, format)) return {};
  } else {
    for (const DepthPixelFormat& candidate : V4l2DepthFormats()) {
      format = &candidate;
      if (OffersFormat(kernel, fd, format)) return {};
    }
  }
  char offered[96];
  ListFormats(kernel, fd, offered);
  return MakeFault(Status::kUnsupported, "%s: offers no %s; it has: %s", name,
                   request.format != nullptr ? request.format->name : "16-bit depth format",
                   offered);
}

/// Sizes to put into S_FMT when none is wanted: what the driver is set to now.
void StartFromCurrent(VideoKernel& kernel, int fd, const StreamRequest& request,
                      v4l2_format& wanted) noexcept {
  wanted = {};
  wanted.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (request.width_px == 0 && kernel.Ioctl(fd, VIDIOC_G_FMT, &wanted) != 0) {
    wanted.fmt.pix = {};
  }
  if (request.width_px > 0) {
    wanted.fmt.pix.width = static_cast<std::uint32_t>(request.width_px);
    wanted.fmt.pix.height = static_cast<std::uint32_t>(request.height_px);
  }
  wanted.fmt.pix.field = V4L2_FIELD_NONE;
  wanted.fmt.pix.bytesperline = 0;  // the driver's own
  wanted.fmt.pix.sizeimage = 0;
}

Fault CheckAnswer(VideoKernel& kernel, int fd, const char* name, const StreamRequest& request,
                  const DepthPixelFormat& format, const v4l2_pix_format& actual) noexcept {
  if (actual.pixelformat != format.fourcc) {
    return MakeFault(Status::kUnsupported, "%s: was asked for %s, but chose '%s'", name,
                     format.name, FourccText(actual.pixelformat).text.data());
  }
  const auto width = static_cast<std::uint32_t>(request.width_px);
  const auto height = static_cast<std::uint32_t>(request.height_px);
  if (request.width_px > 0 && (actual.width != width || actual.height != height)) {
    char offered[128];
    ListSizes(kernel, fd, format.fourcc, offered);
    return MakeFault(Status::kUnsupported,
                     "%s: %s is not delivered at %ux%u, the nearest is %ux%u; sizes: %s", name,
                     format.name, width, height, actual.width, actual.height, offered);
  }
  if (actual.field != V4L2_FIELD_NONE && actual.field != V4L2_FIELD_ANY) {
    return MakeFault(Status::kUnsupported, "%s: delivers interlaced images", name);
  }
  constexpr std::uint32_t kMaxSide = 8192;
  if (actual.width == 0 || actual.height == 0 || actual.width > kMaxSide ||
      actual.height > kMaxSide) {
    return MakeFault(Status::kUnsupported, "%s: its image of %ux%u cannot be used", name,
                     actual.width, actual.height);
  }
  return {};
}

/// Where the depth image lies in a buffer of the driver's.
Fault FillLayout(const char* name, const DepthPixelFormat& format, const v4l2_pix_format& actual,
                 StreamLayout& layout) noexcept {
  layout.format = &format;
  layout.width_px = static_cast<int>(actual.width);
  layout.height_px = static_cast<int>(actual.height);
  const std::size_t row_bytes = MinRowBytes(format, layout.width_px);
  const std::size_t planes = std::size_t{format.planes_before} + 1;
  // Drivers count all planes into the line of such a format.
  layout.stride_bytes = actual.bytesperline / planes;
  if (actual.bytesperline == 0) layout.stride_bytes = row_bytes;
  const auto rows = static_cast<std::size_t>(layout.height_px);
  layout.offset_bytes = layout.stride_bytes * rows * format.planes_before;
  layout.image_bytes = layout.offset_bytes + layout.stride_bytes * (rows - 1) + row_bytes;
  if (layout.stride_bytes < row_bytes || actual.sizeimage < layout.image_bytes) {
    return MakeFault(Status::kUnsupported,
                     "%s: its driver says %u bytes per line and %u per image, too few for %s at "
                     "%dx%d",
                     name, actual.bytesperline, actual.sizeimage, format.name, layout.width_px,
                     layout.height_px);
  }
  return {};
}

float RateOf(const v4l2_fract& interval) noexcept {
  if (interval.numerator == 0) return 0.0F;
  return static_cast<float>(interval.denominator) / static_cast<float>(interval.numerator);
}

Fault SetRate(VideoKernel& kernel, int fd, const char* name, float wanted_hz,
              StreamLayout& layout) noexcept {
  v4l2_streamparm parameters{};
  parameters.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (kernel.Ioctl(fd, VIDIOC_G_PARM, &parameters) != 0) {
    if (errno == ENODEV) return VideoFault(name, "cannot read the frame rate", errno);
    if (wanted_hz == 0.0F) return {};
    return MakeFault(Status::kUnsupported, "%s: has no frame rate to set; leave fps= away", name);
  }
  if (wanted_hz > 0.0F) {
    constexpr std::uint32_t kDenominator = 1000;
    parameters.parm.capture.timeperframe = {
        kDenominator, static_cast<std::uint32_t>(std::lround(wanted_hz * kDenominator))};
    if (kernel.Ioctl(fd, VIDIOC_S_PARM, &parameters) != 0) {
      return VideoFault(name, "cannot set the frame rate", errno);
    }
  }
  layout.rate_hz = RateOf(parameters.parm.capture.timeperframe);
  if (wanted_hz > 0.0F && !(std::abs(layout.rate_hz - wanted_hz) <= kRateTolerance * wanted_hz)) {
    char offered[96];
    ListRates(kernel, fd, layout, offered);
    return MakeFault(Status::kUnsupported,
                     "%s: does not run at %g fps with %s at %dx%d, the nearest is %g; rates: %s",
                     name, static_cast<double>(wanted_hz), layout.format->name, layout.width_px,
                     layout.height_px, static_cast<double>(layout.rate_hz), offered);
  }
  return {};
}

}  // namespace

Fault VideoFault(const char* name, const char* what, int error) noexcept {
  switch (error) {
    case ENODEV:
    case ENXIO:
      return ErrnoFault(Status::kDeviceLost, name, "the camera is gone; plug it in again", error);
    case EBUSY:
      return ErrnoFault(Status::kBusy, name, "in use by another program", error);
    case ENOSPC:
      return ErrnoFault(Status::kBusy, name,
                        "the USB bus has no bandwidth left; use a smaller image, a lower rate or "
                        "another port",
                        error);
    default:
      return ErrnoFault(Status::kIoError, name, what, error);
  }
}

Fault CheckCapabilities(VideoKernel& kernel, int fd, const char* name) noexcept {
  v4l2_capability capability{};
  if (kernel.Ioctl(fd, VIDIOC_QUERYCAP, &capability) != 0) {
    if (errno == ENOTTY || errno == EINVAL) {
      return MakeFault(Status::kUnsupported, "%s: is no V4L2 device", name);
    }
    return VideoFault(name, "cannot be asked for its capabilities", errno);
  }
  const std::uint32_t caps = (capability.capabilities & V4L2_CAP_DEVICE_CAPS) != 0
                                 ? capability.device_caps
                                 : capability.capabilities;
  if ((caps & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    return MakeFault(Status::kUnsupported,
                     "%s: %s; choose another of the camera's nodes, see --list-sensors", name,
                     (caps & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0
                         ? "delivers only multi-planar images"
                         : "captures no images");
  }
  if ((caps & V4L2_CAP_STREAMING) == 0) {
    return MakeFault(Status::kUnsupported, "%s: its driver cannot stream", name);
  }
  return {};
}

bool OffersFormat(VideoKernel& kernel, int fd, const DepthPixelFormat* format) noexcept {
  v4l2_fmtdesc entry{};
  for (std::uint32_t i = 0; NextFormat(kernel, fd, i, entry); ++i) {
    if (format == nullptr ? FindFormat(V4l2DepthFormats(), entry.pixelformat) != nullptr
                          : entry.pixelformat == format->fourcc) {
      return true;
    }
  }
  return false;
}

Fault NegotiateStream(VideoKernel& kernel, int fd, const char* name, const StreamRequest& request,
                      StreamLayout& layout) noexcept {
  const DepthPixelFormat* format = nullptr;
  Fault fault = ChooseFormat(kernel, fd, name, request, format);
  if (!fault.ok()) return fault;
  v4l2_format wanted;
  StartFromCurrent(kernel, fd, request, wanted);
  wanted.fmt.pix.pixelformat = format->fourcc;
  if (kernel.Ioctl(fd, VIDIOC_S_FMT, &wanted) != 0) {
    if (errno != EINVAL) return VideoFault(name, "cannot set the image format", errno);
    return MakeFault(Status::kUnsupported, "%s: refuses %s at %dx%d", name, format->name,
                     request.width_px, request.height_px);
  }
  // Drivers may answer with one thing and do another: what counts is what they say afterwards.
  if (kernel.Ioctl(fd, VIDIOC_G_FMT, &wanted) != 0) {
    return VideoFault(name, "cannot read back the image format", errno);
  }
  StreamLayout chosen;
  fault = CheckAnswer(kernel, fd, name, request, *format, wanted.fmt.pix);
  if (fault.ok()) fault = FillLayout(name, *format, wanted.fmt.pix, chosen);
  if (fault.ok()) fault = SetRate(kernel, fd, name, request.rate_hz, chosen);
  if (fault.ok()) layout = chosen;
  return fault;
}

}  // namespace disflow::posix
