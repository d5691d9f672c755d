// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "sequence_index.h"

namespace disflow::host {

/// Lists a folder of the TUM RGB-D benchmark: depth.txt names every image with its stamp.
[[nodiscard]] hal::Fault ListTumSequence(const ReplayOptions& options, SequenceIndex& index);

/// The camera's poses of groundtruth.txt at the frames' stamps, on the screw motion between the
/// neighbours. Frames before the first, behind the last and in gaps of motion capture get none.
[[nodiscard]] hal::Fault ReadTumWorldPoses(const std::filesystem::path& dir,
                                           std::vector<RecordedFrame>& frames);

}  // namespace disflow::host
