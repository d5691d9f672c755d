// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/hal/fault.h"

namespace disflow::host {

/// A camera and, if its file says so, its image size; 0 = not said.
struct CameraDescription {
  PinholeCamera camera;
  int width_px = 0;
  int height_px = 0;
};

/// Reads cam_K.json or camera-intrinsics.txt (3x3), whichever the sequence has.
[[nodiscard]] hal::Fault ReadCamera(const std::filesystem::path& sequence_dir,
                                    CameraDescription& description);

}  // namespace disflow::host
