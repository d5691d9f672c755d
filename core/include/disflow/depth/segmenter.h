// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/depth/pixel_runs.h"
#include "disflow/estimate.h"

namespace disflow {

/// What is known of the object before a frame is segmented: its predicted pose and extent.
struct ModelPrior {
  bool known = false;
  PoseObjectFromCamera T_oc;      ///< Predicted.
  Vec3 box_min_m = Vec3::Zero();  ///< Axis-aligned bounds of the model, object frame.
  Vec3 box_max_m = Vec3::Zero();
};

/// Decides which pixels are the object: a given mask; else the range gate and a region grown over
/// depth continuity from a seed, and once a model exists only where the predicted model can be.
template <class Limits>
class Segmenter {
 public:
  using Mask = PixelMask<Limits::kMaxImageWidth, Limits::kMaxImageHeight>;

  [[nodiscard]] Status Segment(const DepthFrame& frame, const SegmenterConfig& config,
                               const ModelPrior& prior, Mask& object, Counters& counters) noexcept {
    object.Start(frame.depth.width_px, frame.depth.height_px);
    if (frame.mask.given()) {
      CopyMask(frame.mask, object);
      if (object.count() == 0) return Status::kEmptyMask;
      CutToSurface(frame, config, prior, object, counters);
      return object.count() > 0 ? Status::kOk : Status::kNoValidDepth;
    }
    if (config.grow_region != 0) {
      GrowRegion(frame, config, prior, object, counters);
    } else {
      TakeAll(frame, config, object);
    }
    return object.count() > 0 ? Status::kOk : Status::kNoValidDepth;
  }

 private:
  static void CopyMask(const MaskView& given, Mask& object) noexcept {
    for (int v = 0; v < given.height_px; ++v) {
      const std::uint8_t* row = given.row(v);
      for (int u = 0; u < given.width_px;) {
        while (u < given.width_px && row[u] == 0) ++u;
        const int begin = u;
        while (u < given.width_px && row[u] != 0) ++u;
        object.SetRun(v, begin, u);
      }
    }
    object.Finish();
  }

  /// A loose or late mask also covers background: takes away connected surfaces that cannot be the
  /// object. Single pixels without or with stray depth stay, since without them the outline would
  /// be ragged.
  void CutToSurface(const DepthFrame& frame, const SegmenterConfig& config, const ModelPrior& prior,
                    Mask& object, Counters& counters) noexcept {
    constexpr float kMaskMarginFactor =
        3.0F;  // the mask is evidence too, so the prediction may be farther off
    constexpr int kFewestPixels = 30;
    const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
    const ModelGate gate{frame.camera, prior, kMaskMarginFactor * config.model_margin_m};
    runs_.Build(depth, object.box(), config.depth_jump_ratio,
                [&frame](int u, int v, float) { return frame.mask.row(v)[u] != 0; });
    counters.runs_dropped += static_cast<std::uint32_t>(runs_.dropped());
    const int largest = prior.known ? -1 : ChooseLargest();
    if (prior.known) {
      runs_.Vote([&](const PixelRun& run) {
        return gate(run.u_begin, run.v, depth.At(run.u_begin, run.v));
      });
    }
    runs_.ForEachRun([&](int root, const PixelRun& whole, const PixelRun& run) {
      const bool belongs = prior.known ? 2 * whole.votes >= whole.pixels : root == largest;
      if (!belongs && whole.pixels >= kFewestPixels) object.ClearRun(run.v, run.u_begin, run.u_end);
    });
    object.Finish();
  }

  [[nodiscard]] int ChooseLargest() noexcept {
    int best = -1;
    int most = 0;
    runs_.ForEachComponent([&](int root, const PixelRun&, int pixels) {
      if (pixels <= most) return;
      most = pixels;
      best = root;
    });
    return best;
  }

  /// Everything is the object; the range gate drops what is too far pixel by pixel.
  static void TakeAll(const DepthFrame& frame, const SegmenterConfig& config,
                      Mask& object) noexcept {
    const PixelBox box = SearchBox(frame, config, ModelPrior{});
    for (int v = box.v_min; v < box.v_max; ++v) object.SetRun(v, box.u_min, box.u_max);
    object.Finish();
  }

  void GrowRegion(const DepthFrame& frame, const SegmenterConfig& config, const ModelPrior& prior,
                  Mask& object, Counters& counters) noexcept {
    const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
    const PixelBox box = SearchBox(frame, config, prior);
    runs_.Build(depth, box, config.depth_jump_ratio,
                ModelGate{frame.camera, prior, config.model_margin_m});
    counters.runs_dropped += static_cast<std::uint32_t>(runs_.dropped());
    const int component = ChooseComponent(depth, config, prior, box);
    if (component < 0) return;
    runs_.ForEachRun([&](int root, const PixelRun&, const PixelRun& run) {
      if (root == component) object.SetRun(run.v, run.u_begin, run.u_end);
    });
    object.Finish();
  }

  /// Accepts the pixels whose points lie within the model's bounds plus a margin.
  struct ModelGate {
    const PinholeCamera& camera;
    const ModelPrior& prior;
    float margin_m;

    [[nodiscard]] bool operator()(int u, int v, float depth_m) const noexcept {
      if (!prior.known) return true;
      const Vec3 x_o =
          prior.T_oc * camera.BackProject(static_cast<float>(u), static_cast<float>(v), depth_m);
      return ((x_o - prior.box_min_m).array() > -margin_m).all() &&
             ((prior.box_max_m - x_o).array() > -margin_m).all();
    }
  };

  /// The part of the image worth reading: the region of interest, or around the predicted model.
  [[nodiscard]] static PixelBox SearchBox(const DepthFrame& frame, const SegmenterConfig& config,
                                          const ModelPrior& prior) noexcept {
    PixelBox box{0, 0, frame.depth.width_px, frame.depth.height_px};
    if (prior.known) return ProjectBounds(frame, config, prior, box);
    if (config.roi_width_px > 0 && config.roi_height_px > 0) {
      box.u_min = std::min(config.roi_x_px, box.u_max);
      box.v_min = std::min(config.roi_y_px, box.v_max);
      box.u_max = std::min(box.u_max, box.u_min + config.roi_width_px);
      box.v_max = std::min(box.v_max, box.v_min + config.roi_height_px);
    }
    return box;
  }

  [[nodiscard]] static PixelBox ProjectBounds(const DepthFrame& frame,
                                              const SegmenterConfig& config,
                                              const ModelPrior& prior,
                                              const PixelBox& image) noexcept {
    const Vec3 center_o = 0.5F * (prior.box_min_m + prior.box_max_m);
    const float radius_m =
        0.5F * (prior.box_max_m - prior.box_min_m).norm() + config.model_margin_m;
    const Vec3 center_c = prior.T_oc.Inverse() * center_o;
    const float nearest_m = center_c.z() - radius_m;
    if (nearest_m < config.min_range_m) return image;
    const Vec2 center_px = frame.camera.Project(center_c);
    // Perspective enlarges what is near: the sphere's outline is bounded by its size at the nearest
    // depth.
    const float radius_u = frame.camera.fx_px * radius_m / nearest_m;
    const float radius_v = frame.camera.fy_px * radius_m / nearest_m;
    const auto clamp = [](float px, int high) {
      return static_cast<int>(std::min(std::max(px, 0.0F), static_cast<float>(high)));
    };
    return {clamp(center_px.x() - radius_u, image.u_max),
            clamp(center_px.y() - radius_v, image.v_max),
            clamp(center_px.x() + radius_u + 1.0F, image.u_max),
            clamp(center_px.y() + radius_v + 1.0F, image.v_max)};
  }

  /// The component under the seed pixel; else the largest; before a model exists, larger counts for
  /// less when farther away, so that the object in front wins over the wall behind it.
  [[nodiscard]] int ChooseComponent(const DepthReader& depth, const SegmenterConfig& config,
                                    const ModelPrior& prior, const PixelBox& box) noexcept {
    if (!prior.known && config.seed_u_px >= 0 && config.seed_v_px >= 0) {
      return runs_.ComponentAt(config.seed_u_px, config.seed_v_px);
    }
    const int min_pixels = std::max(64, box.width() * box.height() / 2000);
    int best = -1;
    float best_score = 0.0F;
    runs_.ForEachComponent([&](int root, const PixelRun& first, int pixels) {
      if (pixels < min_pixels) return;
      const float depth_m = depth.At(first.u_begin, first.v);
      const float score =
          prior.known ? static_cast<float>(pixels) : 1.0F / std::max(depth_m, config.min_range_m);
      if (score > best_score) {
        best_score = score;
        best = root;
      }
    });
    return best;
  }

  PixelRuns<Limits::kMaxRuns> runs_;
};

}  // namespace disflow
