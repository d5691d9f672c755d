// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/posix/camera/camera_list.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "disflow/posix/camera/camera_model.h"
#include "disflow/posix/camera/depth_pixel_format.h"
#include "disflow/posix/camera/video_node.h"
#include "v4l2_format.h"
#include "v4l2_offers.h"

namespace disflow::posix {
namespace {

std::string DescribeIdentity(const VideoNode& node) {
  if (!node.is_usb) return "  on " + (node.bus.empty() ? std::string("?") : node.bus) + "\n";
  std::array<char, 64> ids{};
  (void)std::snprintf(ids.data(), ids.size(), "  USB %04x:%04x", unsigned{node.vendor_id},
                      unsigned{node.product_id});
  std::string text = ids.data();
  text += node.serial.empty() ? ", no serial number" : ", serial " + node.serial;
  if (const CameraModel* model = FindCameraModel(node.vendor_id, node.product_id)) {
    std::array<char, 64> unit{};
    (void)std::snprintf(unit.data(), unit.size(), " (%s, depth_scale %g)", model->name,
                        static_cast<double>(model->unit_m));
    text += unit.data();
  }
  return text + "\n";
}

std::string DescribeSize(VideoKernel& kernel, int fd, std::uint32_t fourcc,
                         const v4l2_frmsizeenum& size) {
  std::array<char, 96> rates{};
  std::array<char, 192> line{};
  if (size.type == V4L2_FRMSIZE_TYPE_DISCRETE) {
    ListRates(kernel, fd, fourcc, size.discrete.width, size.discrete.height, rates);
    (void)std::snprintf(line.data(), line.size(), "    %ux%u at %s fps\n", size.discrete.width,
                        size.discrete.height, rates.data());
  } else {
    const v4l2_frmsize_stepwise& range = size.stepwise;
    ListRates(kernel, fd, fourcc, range.max_width, range.max_height, rates);
    (void)std::snprintf(line.data(), line.size(), "    %ux%u to %ux%u, the largest at %s fps\n",
                        range.min_width, range.min_height, range.max_width, range.max_height,
                        rates.data());
  }
  return line.data();
}

std::string DescribeFormats(VideoKernel& kernel, int fd, bool& has_depth) {
  std::string text;
  v4l2_fmtdesc format;
  for (std::uint32_t i = 0; NextFormat(kernel, fd, i, format); ++i) {
    const DepthPixelFormat* const depth = FindFormat(V4l2DepthFormats(), format.pixelformat);
    has_depth = has_depth || depth != nullptr;
    text += depth != nullptr ? std::string("  format=") + depth->name + "\n"
                             : std::string("  ") + FourccText(format.pixelformat).text.data() +
                                   " (no depth format)\n";
    v4l2_frmsizeenum size;
    for (std::uint32_t k = 0; NextSize(kernel, fd, k, format.pixelformat, size); ++k) {
      text += DescribeSize(kernel, fd, format.pixelformat, size);
      if (size.type != V4L2_FRMSIZE_TYPE_DISCRETE) break;
    }
  }
  return text;
}

std::string DescribeNode(VideoKernel& kernel, const VideoNode& node) {
  std::string text = "v4l2:" + node.path + "  " + node.name + "\n" + DescribeIdentity(node);
  const int fd = kernel.Open(node.path.c_str());
  if (fd < 0) return text + "  cannot be opened: " + std::strerror(errno) + "\n";
  bool has_depth = false;
  const hal::Fault fault = CheckCapabilities(kernel, fd, node.path.c_str());
  if (fault.ok()) {
    text += DescribeFormats(kernel, fd, has_depth);
    if (!has_depth) text += "  no 16-bit depth format: cannot be used\n";
  } else {
    text += std::string("  cannot be used: ") + fault.message + "\n";
  }
  kernel.Close(fd);
  return text;
}

}  // namespace

std::string DescribeV4l2Cameras(VideoKernel& kernel, const std::string& sys_root,
                                const std::string& dev_root) {
  std::string text;
  for (const VideoNode& node : ListVideoNodes(sys_root, dev_root)) {
    text += DescribeNode(kernel, node);
  }
  return text.empty() ? "no V4L2 device; is the camera plugged in?\n" : text;
}

}  // namespace disflow::posix
