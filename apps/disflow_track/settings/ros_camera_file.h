// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "disflow/posix/camera/camera_description.h"

namespace disflow::apps {

/// Whether a file is in the form in which ROS's camera_calibration keeps a camera, by its name.
[[nodiscard]] bool IsRosCameraFile(const std::string& path);

/// Reads image_width, image_height and camera_matrix of such a file, or projection_matrix in place
/// of the latter. Distortion that nobody undoes is refused: the tracker takes rectified images.
/// @param rectified The driver's images are, by this calibration: projection_matrix is of them.
/// @throws Failure kWrongUsage with file, line and key.
[[nodiscard]] posix::CameraDescription ReadRosCameraFile(const std::string& path, bool rectified);

}  // namespace disflow::apps
