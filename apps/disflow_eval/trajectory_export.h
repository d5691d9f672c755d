// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "report.h"

/// @file
/// Poses for the tools of others, of the true object frame, with which the run was aligned once.
/// Only frames whose pose was measured.

namespace disflow::apps {

/// Lines `stamp tx ty tz qx qy qz qw`, object in the camera's frame, as the TUM RGB-D benchmark has
/// them and evo reads them.
[[nodiscard]] std::string FormatTum(const Report& report);
/// The truth of every frame in the same form. @throws InputError if the sequence has no stamps.
[[nodiscard]] std::string FormatTumTruth(const Report& report);
/// Results of the BOP benchmark: `scene_id,im_id,obj_id,score,R,t,time`.
/// @param object Its obj_id, 1 if it is no number; scene_id is the number that the sequence's
/// folder is called by, else 1.
[[nodiscard]] std::string FormatBop(const Report& report, const std::string& object);

}  // namespace disflow::apps
