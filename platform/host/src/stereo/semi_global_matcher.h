// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

/// @file
/// OpenCV's semi-global matching, in a module of its own that is loaded when it is wanted: programs
/// neither need OpenCV to start nor to be installed.

namespace disflow::host {

/// Parameters of cv::StereoSGBM, under its names.
struct SemiGlobalSettings {
  int min_disparity = 0;
  int num_disparities = 112;  ///< A multiple of 16.
  int block_size = 5;
  int p1 = 200;
  int p2 = 800;
  int disp12_max_diff = 1;  ///< < 0 = no left-right check.
  int pre_filter_cap = 31;
  int uniqueness_ratio = 5;
  int speckle_window_size = 60;
  int speckle_range = 1;
};

inline constexpr int kDisparitySteps = 16;  ///< Disparities come as multiples of 1/16 px.

/// The module's one function. Images of width x height, 8 bits, without padding; a negative
/// disparity is none.
using MatchFunction = void (*)(const SemiGlobalSettings* settings, const std::uint8_t* left,
                               const std::uint8_t* right, int width_px, int height_px,
                               std::int16_t* disparity_16ths);
inline constexpr const char* kMatchFunctionName = "disflow_match_semi_globally";

/// @return nullptr if the module is not beside the program, or OpenCV is missing.
[[nodiscard]] MatchFunction FindSemiGlobalMatcher();

}  // namespace disflow::host
