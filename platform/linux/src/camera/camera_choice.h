// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "disflow/hal/fault.h"
#include "disflow/posix/camera/camera_address.h"
#include "disflow/posix/camera/camera_description.h"
#include "disflow/posix/camera/depth_pixel_format.h"
#include "disflow/posix/camera/video_node.h"

namespace disflow::posix {

/// Image size and intrinsics that address and description agree on.
/// @return kInvalidIntrinsics with what is missing or contradicts.
[[nodiscard]] hal::Fault ChooseIntrinsics(const CameraAddress& address,
                                          const CameraDescription& description,
                                          CameraDescription& chosen) noexcept;

/// Metres per unit: as the address says, else the description, else the model's documented one.
/// Never guessed.
/// @return kUnsupported if nobody says it.
[[nodiscard]] hal::Fault ChooseUnit(const CameraAddress& address,
                                    const CameraDescription& description,
                                    const DepthPixelFormat& format, const VideoNode& node,
                                    float& unit_m) noexcept;

}  // namespace disflow::posix
