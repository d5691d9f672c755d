// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "disflow/depth/depth_frame.h"
#include "frames.h"
#include "sequence.h"

namespace disflow::apps {

/// A model point counts as seen if the depth image agrees with its projection to within this.
inline constexpr double kSeenTolerance_m = 0.005;

/// Marks the points that a depth image shows: they face the camera (if they have a normal) and the
/// image's depth where they project is theirs.
/// @param frame Checked with CheckFrame() by the caller.
/// @param T_ct True pose of the object in that frame.
/// @param seen One entry per point; points once marked stay marked.
void MarkSeen(const DepthFrame& frame, const TruePose& T_ct,
              const std::vector<SurfacePoint>& points, std::vector<bool>& seen);

/// Which points the depth images of a sequence show; every few frames are looked at, since
/// neighbours show nearly the same.
/// @return One entry per point, or nothing if the sequence has no depth images.
/// @throws InputError if one of them is malformed.
[[nodiscard]] std::vector<bool> FindSeen(const Sequence& sequence,
                                         const std::vector<SurfacePoint>& points);

}  // namespace disflow::apps
