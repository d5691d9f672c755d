// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frames.h"

namespace disflow::apps {

/// What really happened, frame by frame; all lists are of equal length or empty.
struct GroundTruth {
  std::vector<TruePose> T_ct;      ///< Never empty.
  std::vector<PointTwist> twists;  ///< Empty if the sequence has no gt/velocities.txt.
  std::vector<int> file_indices;   ///< Number in the names of a frame's depth and mask files.
  std::vector<double> stamps_s;    ///< Empty if the sequence has no data.txt.
};

/// Reads gt/poses.txt, gt/velocities.txt and data.txt of a sequence in the Fast-YCB layout.
/// @param object Of a sequence with several objects: they have a folder of their name in gt/.
/// @throws InputError naming file, line and reason.
[[nodiscard]] GroundTruth LoadGroundTruth(const std::filesystem::path& sequence_dir,
                                          const std::string& object = {});

/// The folder that holds the truth and the model of an object.
[[nodiscard]] std::filesystem::path TruthFolder(const std::filesystem::path& sequence_dir,
                                                const std::string& object);

}  // namespace disflow::apps
