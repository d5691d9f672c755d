// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/pinhole_camera.h"

namespace disflow::posix {

/// What is known of a camera's depth stream at one image size, mostly from a file.
struct CameraDescription {
  int width_px = 0;  ///< 0 = not said.
  int height_px = 0;
  PinholeCamera camera;
  float unit_m = 0.0F;  ///< 0 = not said.
};

}  // namespace disflow::posix
