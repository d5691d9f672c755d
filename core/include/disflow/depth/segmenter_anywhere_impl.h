// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "disflow/depth/model_gate.h"
#include "disflow/depth/segmenter.h"

/// @file
/// Definition of that member of Segmenter that looks for a lost object in all of the image; apart,
/// so that tracker.h stays light.

namespace disflow {

/// A search about the prediction cuts off what comes back elsewhere, and a piece is not recognised.
/// Surfaces of the whole image are whole. An object that is one surface with what it touches is too
/// large, and is left to the search about the prediction.
template <class Limits>
template <class Explains>
bool Segmenter<Limits>::LookAnywhere(const DepthFrame& frame, const SegmenterConfig& config,
                                     const ModelPrior& prior, Explains& explains,
                                     Mask& object) noexcept {
  // Of the diagonal of the model's bounds. What was not seen yet may come into view, and of what is
  // known an end or a side may be all that does; between a half and twice as much is the same.
  constexpr float kLargest = 1.3F;
  constexpr float kSmallest = 0.4F;
  const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
  manner_ = {};
  planes_.Clear();
  valleys_.Clear();
  votes_ = {};
  box_ = {0, 0, frame.depth.width_px, frame.depth.height_px};
  planes_.Find(depth, box_, [](int, int, float) { return true; });
  Connect(frame, config, depth, kMinPixels, [](int, int, int, float*) {});

  std::array<Eigen::AlignedBox3f, static_cast<std::size_t>(Surfaces::kMaxComponents)> bounds_c;
  surfaces_.ForEachRun([&](int c, const PixelRun& run) {
    if (c == Surfaces::kNoComponent) return;
    for (const int u : {static_cast<int>(run.u_begin), run.u_end - 1}) {
      const auto depth_m = depth.AtOrZero(u, run.v);
      if (depth_m > 0.0F)
        bounds_c[static_cast<std::size_t>(c)].extend(
            frame.camera.BackProject(static_cast<float>(u), static_cast<float>(run.v), depth_m));
    }
  });
  const float model_m = (prior.box_max_m - prior.box_min_m).norm();
  const Vec3 predicted_c = prior.T_oc.Inverse() * Vec3(0.5F * (prior.box_max_m + prior.box_min_m));
  int nearest = Surfaces::kNoComponent;
  float nearest_m = 0.0F;
  for (int c = 0; c < surfaces_.components(); ++c) {
    const Eigen::AlignedBox3f& bounds = bounds_c[static_cast<std::size_t>(c)];
    const float size_m = bounds.isEmpty() ? 0.0F : bounds.diagonal().norm();
    if (size_m < kSmallest * model_m || size_m > kLargest * model_m) continue;
    const float away_m = (bounds.center() - predicted_c).norm();
    if (nearest != Surfaces::kNoComponent && away_m >= nearest_m) continue;
    nearest = c;
    nearest_m = away_m;
  }
  if (nearest == Surfaces::kNoComponent) return false;
  vote(nearest).chosen = true;
  elsewhere_ = !GateOf(frame, config, prior)
                    .Accepts(Vec3(bounds_c[static_cast<std::size_t>(nearest)].center()));
  Redraw(frame, prior, explains, object);
  return true;
}

}  // namespace disflow
