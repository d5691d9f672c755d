// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/hal/camera_pose_history.h"
#include "settings/options.h"

namespace disflow::apps {

/// Where the optical frame sits in the body that carries it; not told: at its origin, looking along
/// its x axis, the image upright.
[[nodiscard]] Transform<hal::Body, Camera, double> CameraInBody(const CameraPoseOptions& options);

}  // namespace disflow::apps
