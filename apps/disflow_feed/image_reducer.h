// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "disflow/depth/depth_frame.h"

namespace disflow::apps {

/// Makes depth images small enough for a controller: blocks of k x k pixels become one, the mean
/// of 1/z over the pixels of the surface that most of them show, in units of kUnit_m.
class ImageReducer {
 public:
  /// Fine beside a camera's noise; reaches 6.5 m.
  static constexpr float kUnit_m = 1e-4F;

  /// @param max_width_px,max_height_px k is the smallest number that makes an image fit.
  ImageReducer(int max_width_px, int max_height_px)
      : max_width_px_(max_width_px), max_height_px_(max_height_px) {}

  /// @return A view of the reduced image, valid until the next call. The mask is not kept.
  [[nodiscard]] DepthFrame Reduce(const DepthFrame& frame);

 private:
  [[nodiscard]] std::uint16_t Block(const DepthFrame& frame, int u, int v, int k);

  int max_width_px_;
  int max_height_px_;
  std::vector<std::uint16_t> pixels_;
  std::vector<float> inverse_;  // 1/z of a block's pixels
};

}  // namespace disflow::apps
