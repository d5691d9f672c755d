// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/segmenter.h"

namespace disflow {

bool BelongsToObject(const SurfaceVote& vote, int pixels, bool masked) noexcept {
  const bool explained = vote.probed > 0 && 10 * vote.explained >= 3 * vote.probed;
  if (!masked) return explained || vote.probed == 0;
  if (2 * vote.masked < pixels) return vote.masked > 0 && explained;
  // The mask has it already: only a model that plainly contradicts keeps it out.
  constexpr int kMinProbed = 4;
  return vote.probed < kMinProbed || 10 * vote.explained >= vote.probed;
}

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

}  // namespace disflow
