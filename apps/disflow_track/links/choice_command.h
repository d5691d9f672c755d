// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "disflow/hal/mavlink/messages.h"
#include "objects/object_choice.h"

namespace disflow::apps {

/// What MAV_CMD_CAMERA_TRACK_POINT and MAV_CMD_CAMERA_TRACK_RECTANGLE point at.
/// @return Nothing for places outside of the image and empty boxes.
/// @pre IsChoiceCommand()
[[nodiscard]] std::optional<ObjectChoice> ChoiceOf(
    const hal::mavlink::CommandLong& command) noexcept;

[[nodiscard]] inline bool IsChoiceCommand(const hal::mavlink::CommandLong& command) noexcept {
  return command.command == hal::mavlink::CommandLong::kCameraTrackPoint ||
         command.command == hal::mavlink::CommandLong::kCameraTrackRectangle;
}

}  // namespace disflow::apps
