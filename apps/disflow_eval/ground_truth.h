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
  std::string note;  ///< What was left out of a sequence that was cut short; empty: nothing.
};

/// Reads gt/poses.txt, gt/velocities.txt and data.txt of a sequence in the Fast-YCB layout. Of one
/// that was cut short (see SequenceWriter) the frames that data.txt lists.
/// @param object Of a sequence with several objects: they have a folder of their name in gt/.
/// @throws InputError naming file, line and reason.
[[nodiscard]] GroundTruth LoadGroundTruth(const std::filesystem::path& sequence_dir,
                                          const std::string& object = {});

/// Whether a folder is a scene of the BOP benchmark.
[[nodiscard]] bool IsBopScene(const std::filesystem::path& dir);

/// Reads scene_gt.json of such a scene, which has neither velocities nor stamps.
/// @param object Its obj_id; gtN for the N-th of each image; empty for the only one.
/// @param id The obj_id of the object that was chosen.
/// @throws InputError naming file, image and reason; also if an image does not show the object.
[[nodiscard]] GroundTruth LoadBopTruth(const std::filesystem::path& dir, const std::string& object,
                                       int& id);

/// The folder that holds the truth and the model of an object.
[[nodiscard]] std::filesystem::path TruthFolder(const std::filesystem::path& sequence_dir,
                                                const std::string& object);

}  // namespace disflow::apps
