// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "disflow/posix/camera/camera_description.h"

namespace disflow::apps {

/// Focal lengths and principal points beyond this are a fault in the file.
inline constexpr double kMaxIntrinsic_px = 1e5;

/// Reads a TOML file with width, height, fx, fy, cx, cy and, if wanted, depth_scale; or, by the
/// name .yaml or .yml, one of ROS's camera_calibration.
/// @param rectified See ReadRosCameraFile(). Nothing changes for TOML: it has no distortion, and
/// its numbers are those of the images that come.
/// @throws Failure kWrongUsage with file, line and key.
[[nodiscard]] posix::CameraDescription ReadCameraFile(const std::string& path,
                                                      bool rectified = false);

}  // namespace disflow::apps
