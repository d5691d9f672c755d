// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "estimate_csv.h"
#include "ground_truth.h"

/// @file
/// Trajectories in the formats of others. They say less than a CSV of disflow_track: neither
/// velocities nor covariances, and nothing of frames without a pose.

namespace disflow::apps {

/// Reads a trajectory in whichever format it is: a CSV of disflow_track, poses of the object in the
/// camera's frame as the TUM RGB-D benchmark writes them (`stamp tx ty tz qx qy qz qw`), or results
/// of the BOP benchmark (`scene_id,im_id,obj_id,score,R,t,time`).
/// @param truth Frames that rows belong to: those of TUM by their stamps, those of BOP by the
/// image's number.
/// @param object Of BOP: rows of this obj_id; empty or no number: the only one there is.
/// @throws InputError naming file, line and reason.
[[nodiscard]] EstimateTable LoadTrajectory(const std::filesystem::path& file,
                                           const GroundTruth& truth, const std::string& object);

}  // namespace disflow::apps
