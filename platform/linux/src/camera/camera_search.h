// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "disflow/hal/fault.h"
#include "disflow/posix/camera/camera_address.h"
#include "disflow/posix/camera/video_kernel.h"
#include "disflow/posix/camera/video_node.h"

namespace disflow::posix {

/// Where to look for which camera.
struct CameraSearch {
  VideoKernel& kernel;
  const CameraAddress& address;
  const std::string& sys_root;
  const std::string& dev_root;
};

/// Finds the device that the address means.
/// @param known The device that was in use before it went away: only the same one is taken.
/// @return kNotFound with what is there instead.
[[nodiscard]] hal::Fault FindCamera(const CameraSearch& search,
                                    const std::optional<VideoNode>& known, VideoNode& node);

}  // namespace disflow::posix
