// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "disflow/host/image_noise.h"

namespace disflow::host {

/// A camera that measures disparity f b / z between two views, as stereo and structured light do.
struct DisparityModel {
  double focal_baseline_px_m = 0.0;  ///< f b.
  double std_px = 0.0;               ///< Gaussian noise of the disparity.
  double step_px = 0.0;              ///< Disparities are rounded to multiples of this.
  double lateral_std_px = 0.0;       ///< A pixel shows the depth of a place this far away.
  double hole_share = 0.0;           ///< Pixels without data, single ones.
  double hole_blobs_share = 0.0;     ///< Centres of small round holes, per pixel.
  double flying_share = 0.0;         ///< Pixels at depth jumps with a depth between the two sides.
  double edge_hole_share = 0.0;      ///< Pixels at depth jumps without data.
  ImageNoiseModel image_noise = {};  ///< Kernel 0: neither pixels nor frames know of each other.
  double fattening_px = 0.0;         ///< How far an object seems to reach over its right outline,
  double fattening_std_px = 0.0;     ///< and how much that varies.
};

/// The spread of a D415, independent from pixel to pixel and from frame to frame as no camera's is:
/// 55 mm baseline, 0.08 px noise, 1/32 px steps.
[[nodiscard]] DisparityModel WhiteModel(double fx_px);
/// D415-like: the same spread, correlated with a kernel of 1.5 px and by 0.7 from frame to frame at
/// rest; outlines are fattened. Lengths are those of 640 px image width and grow with it.
[[nodiscard]] DisparityModel D415Model(double fx_px, int width_px);
/// Kinect-like (structured light): f b = 580 px x 75 mm, 1/8 px steps, lateral noise.
[[nodiscard]] DisparityModel KinectModel();

/// Turns exact images into what such a camera would deliver, shadow of the second view included.
/// Frame k's noise depends on seed and k only.
class SensorNoise {
 public:
  SensorNoise(const DisparityModel& model, int width_px, int height_px, std::uint64_t seed);

  /// @param inverse_depth_per_m Exact image, row-major, 0 = nothing there.
  /// @param depth_m Measured image of the same size, 0 = no data.
  void Apply(int frame, std::span<const float> inverse_depth_per_m, std::span<float> depth_m);

 private:
  void Fatten();
  void MarkEdges();
  [[nodiscard]] float MeasurePixel(int u, int v, BitSource& bits) const;

  DisparityModel model_;
  int width_;
  int height_;
  std::uint64_t seed_;
  NormalTable normal_;
  std::optional<ImageNoise> image_noise_;
  std::vector<float> disparity_px_;       // exact
  std::vector<float> shown_px_;           // with fattened outlines
  std::vector<float> edge_neighbour_px_;  // disparity on the other side of a jump, < 0 = no jump
};

}  // namespace disflow::host
