// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesh_metrics.h"

/// @file
/// The public Fast-YCB data set (doi:10.48557/G2QJDM), tracked and judged as a whole.

namespace disflow::apps {

/// Its labelled sequences; each is a folder of this name.
inline constexpr std::array<const char*, 6> kFastYcbObjects = {
    "003_cracker_box",    "004_sugar_box",   "005_tomato_soup_can",
    "006_mustard_bottle", "009_gelatin_box", "010_potted_meat_can"};
/// Its mask sets: exact ones, and those of a segmentation network.
inline constexpr std::array<const char*, 2> kFastYcbMasks = {"gt", "mrcnn_ycbv_bop_pbr"};

struct FastYcbOptions {
  std::filesystem::path data;    ///< Holds the objects' folders.
  std::filesystem::path models;  ///< Holds NAME.obj, NAME.xyz or NAME/textured.obj; may be empty.
  std::filesystem::path out =
      "fast-ycb-results";       ///< Trajectories, meshes and tables are left here.
  std::filesystem::path track;  ///< The program disflow_track.
  std::string config;           ///< Settings file for it; may be empty.
};

/// What the paper's tables show, of one object with one mask set.
struct FastYcbResult {
  std::string object;
  std::string mask;
  double add_auc_percent = 0.0;
  double translation_cm = 0.0;  ///< RMSE, as all of these.
  double rotation_deg = 0.0;
  double linear_cmps = 0.0;  ///< NaN without gt/velocities.txt.
  double angular_degps = 0.0;
  double median_ms = 0.0;  ///< Per frame.
  std::optional<MeshComparison> surface;
};

/// Tracks and judges every sequence that is there.
/// @param say Receives one line per sequence that is missing or cannot be used, by name, and why.
/// @throws InputError if `data` is no folder or none of its sequences can be used.
[[nodiscard]] std::vector<FastYcbResult> EvaluateFastYcb(
    const FastYcbOptions& options, const std::function<void(const std::string&)>& say);

/// The paper's tables I to IV with the results beside the published figures, in Markdown.
[[nodiscard]] std::string FormatFastYcb(const std::vector<FastYcbResult>& results);

}  // namespace disflow::apps
