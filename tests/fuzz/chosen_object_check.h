// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "file_in_memory.h"
#include "objects/object_choice.h"

namespace disflow::fuzz {

/// What somebody chooses lies in the image, or is none.
inline void CheckStart(const apps::ObjectChoice& choice, int width_px, int height_px) {
  DepthFrame frame;
  frame.depth.width_px = width_px;
  frame.depth.height_px = height_px;
  frame.camera = {20.0F, 20.0F, 8.0F, 6.0F};
  const auto start = apps::StartIn(frame, choice);
  if (!start) return;
  Require(start->seed_u_px >= -1 && start->seed_u_px < width_px);
  Require(start->seed_v_px >= -1 && start->seed_v_px < height_px);
  Require(start->roi_x_px >= 0 && start->roi_x_px < width_px && start->roi_width_px <= width_px);
  Require(start->seed_reach_px >= 0 && start->seed_reach_px <= width_px);
  if (choice.kind == apps::ObjectChoice::Kind::kMask)
    Require(choice.mask.size() ==
            static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
}

}  // namespace disflow::fuzz
