// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "disflow/posix/camera/video_kernel.h"

namespace disflow::posix {

/// Every V4L2 device with its formats, sizes and rates, and the address of those that deliver
/// depth; text for people, some lines per device.
[[nodiscard]] std::string DescribeV4l2Cameras(VideoKernel& kernel = LinuxVideoKernel(),
                                              const std::string& sys_root = "/sys",
                                              const std::string& dev_root = "/dev");

}  // namespace disflow::posix
