// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "disflow/depth/model_gate.h"
#include "disflow/depth/segmenter.h"

/// @file
/// The part of Segmenter that works with the predicted model's bounds; apart, so that tracker.h
/// stays light.

namespace disflow {

template <class Limits>
void Segmenter<Limits>::BuildSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                                      const ModelPrior& prior, const Mask& mask,
                                      Counters& counters) noexcept {
  const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
  const bool masked = frame.mask.given();
  if (prior.known) {
    const float factor = masked ? kMaskMarginFactor : 1.0F;
    const float margin_m =
        factor * config.model_margin_m + (prior.doubtful ? config.lost_margin_m : 0.0F);
    const ModelGate gate(frame.camera, prior, margin_m);
    box_ = gate.SearchBox(config.min_range_m, {0, 0, frame.depth.width_px, frame.depth.height_px});
    planes_.Clear();
    if (!masked) {
      planes_.Find(depth, box_, [&](int u, int v, float depth_m) {
        return !gate.Accepts(
            frame.camera.BackProject(static_cast<float>(u), static_cast<float>(v), depth_m));
      });
    }
    surfaces_.Build(depth, box_, config.depth_jump_ratio, kMinPixels,
                    [&](int v, int u_begin, int u_end, float* depth_m) {
                      gate(v, u_begin, u_end, depth_m);
                      planes_(v, u_begin, u_end, depth_m);
                    });
  } else if (masked) {
    // So much more than the mask that a surface which goes on beyond its tolerance is seen to.
    const int margin_px = band_.tolerance_px() + kBeyondBand_px;
    box_ = {std::max(mask.box().u_min - margin_px, 0), std::max(mask.box().v_min - margin_px, 0),
            std::min(mask.box().u_max + margin_px, mask.width_px()),
            std::min(mask.box().v_max + margin_px, mask.height_px())};
    surfaces_.Build(depth, box_, config.depth_jump_ratio, kMinPixels, [](int, int, int, float*) {});
  } else {
    box_ = RegionOfInterest(frame, config);
    const int fewest_pixels = std::max(64, box_.width() * box_.height() / 2000);
    planes_.Find(depth, box_, [](int, int, float) { return true; });
    surfaces_.Build(depth, box_, config.depth_jump_ratio, fewest_pixels, planes_);
    if (surfaces_.components() == 0) {  // nothing but planes: one of them is the object's own
      planes_.Clear();
      surfaces_.Build(depth, box_, config.depth_jump_ratio, fewest_pixels, planes_);
    }
  }
  counters.runs_dropped += static_cast<std::uint32_t>(surfaces_.dropped());
}

}  // namespace disflow
