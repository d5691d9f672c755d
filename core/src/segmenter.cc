// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/segmenter.h"

namespace disflow {

PixelBox RegionOfInterest(const DepthFrame& frame, const SegmenterConfig& config) noexcept {
  PixelBox box{0, 0, frame.depth.width_px, frame.depth.height_px};
  if (config.roi_width_px > 0 && config.roi_height_px > 0) {
    box.u_min = std::min(config.roi_x_px, box.u_max);
    box.v_min = std::min(config.roi_y_px, box.v_max);
    box.u_max = std::min(box.u_max, box.u_min + config.roi_width_px);
    box.v_max = std::min(box.v_max, box.v_min + config.roi_height_px);
  }
  return box;
}

PixelBox Surroundings(const PixelBox& region, const DepthFrame& frame) noexcept {
  const int du = region.width() / 2;
  const int dv = region.height() / 2;
  return {std::max(0, region.u_min - du), std::max(0, region.v_min - dv),
          std::min(frame.depth.width_px, region.u_max + du),
          std::min(frame.depth.height_px, region.v_max + dv)};
}

}  // namespace disflow
