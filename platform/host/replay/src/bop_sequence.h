// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sequence_index.h"

namespace disflow::host {

/// Lists a scene of the BOP benchmark: scene_camera.json, depth/, and masks of the objects of
/// scene_gt.json. With `T_wc=poses` also the camera's poses.
[[nodiscard]] hal::Fault ListBopSequence(const ReplayOptions& options, SequenceIndex& index);

}  // namespace disflow::host
