// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "disflow/config.h"
#include "disflow/depth/depth_frame.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/model_prior.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/depth/pixel_runs.h"
#include "disflow/depth/plane_removal.h"
#include "disflow/estimate.h"

namespace disflow {

/// What mask and model say of one connected surface.
struct SurfaceVote {
  bool chosen = false;
  int masked = 0;     ///< Its pixels within the mask.
  int probed = 0;     ///< Its points that the model was asked about.
  int explained = 0;  ///< Of these, those near known surface.
};

/// Whether a surface is the object's, once there is a model.
/// @param pixels Of the surface.
/// @param masked Whether a mask was given.
[[nodiscard]] bool BelongsToObject(const SurfaceVote& vote, int pixels, bool masked) noexcept;

/// The part of the image that the settings leave.
[[nodiscard]] PixelBox RegionOfInterest(const DepthFrame& frame,
                                        const SegmenterConfig& config) noexcept;

/// Decides which pixels are the object. The depth image is cut into connected surfaces within reach
/// of the predicted model (or, before there is a model, within range and region of interest); the
/// model and the mask, if one is given, say which of them are the object. A given mask is believed
/// to the pixel only where the depth image agrees with it.
template <class Limits>
class Segmenter {
 public:
  using Mask = PixelMask<Limits::kMaxImageWidth, Limits::kMaxImageHeight>;

  /// @param explains explains(x_c): whether known surface of the predicted model is near a point of
  /// the camera frame. Only called if prior.known.
  template <class Explains>
  [[nodiscard]] Status Segment(const DepthFrame& frame, const SegmenterConfig& config,
                               const ModelPrior& prior, Explains&& explains, Mask& object,
                               Counters& counters) noexcept {
    object.Start(frame.depth.width_px, frame.depth.height_px);
    if (frame.mask.given()) {
      const PixelBox image{0, 0, frame.mask.width_px, frame.mask.height_px};
      CopyMask(frame.mask, image, object);
      if (object.count() == 0) return Status::kEmptyMask;
    }
    if (!frame.mask.given() && config.grow_region == 0) {
      TakeAll(frame, config, object);
    } else {
      BuildSurfaces(frame, config, prior, object, counters);
      ChooseSurfaces(frame, config, prior, explains, object);
      if (!frame.mask.given() || !IsExact(object)) Redraw(frame, prior, explains, object);
    }
    object.Finish();
    return object.count() > 0 ? Status::kOk : Status::kNoValidDepth;
  }

 private:
  using Surfaces = PixelRuns<Limits::kMaxRuns, Limits::kMaxImageWidth>;
  static constexpr int kMinPixels = 30;  ///< Of a surface that may be the object.
  /// The mask is evidence too, so the prediction may be farther off.
  static constexpr float kMaskMarginFactor = 2.0F;

  static void CopyMask(const MaskView& given, const PixelBox& box, Mask& object) noexcept {
    for (int v = box.v_min; v < box.v_max; ++v)
      object.SetFromBytes(v, box.u_min, box.u_max, given.row(v), given.label);
    object.Finish();
  }

  /// Everything is the object; the range gate drops what is too far pixel by pixel.
  static void TakeAll(const DepthFrame& frame, const SegmenterConfig& config,
                      Mask& object) noexcept {
    const PixelBox box = RegionOfInterest(frame, config);
    for (int v = box.v_min; v < box.v_max; ++v) object.row(v).SetRun(box.u_min, box.u_max);
  }

  /// Connected surfaces of what could be the object.
  void BuildSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                     const ModelPrior& prior, const Mask& mask, Counters& counters) noexcept;

  template <class Explains>
  void ChooseSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                      const ModelPrior& prior, Explains& explains, const Mask& mask) noexcept {
    votes_ = {};
    const int count = surfaces_.components();
    if (!prior.known) {
      const int first = ChooseFirst(frame, config);
      if (first < count) vote(first).chosen = true;
      return;
    }
    const bool masked = frame.mask.given();
    bool clear = count == 1;  // no need to ask the model
    if (masked) {
      surfaces_.ForEachRun([&](int c, const PixelRun& run) {
        if (c != Surfaces::kNoComponent)
          vote(c).masked += mask.row(run.v).CountRun(run.u_begin, run.u_end);
      });
      clear = clear && 2 * vote(0).masked >= surfaces_.component(0).pixels;
    }
    if (!clear && !prior.doubtful) {
      const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
      surfaces_.ForEachRun([&](int c, const PixelRun& run) {
        if (c != Surfaces::kNoComponent && run.v % kProbeStepPx == 0)
          Probe(depth, frame.camera, explains, run, vote(c));
      });
    }
    for (int c = 0; c < count; ++c)
      vote(c).chosen =
          !prior.doubtful && BelongsToObject(vote(c), surfaces_.component(c).pixels, masked);
    if (ExplainsTooLittle(masked)) ChooseUnexplained(masked);
  }

  /// Whether next to nothing of what could be the object is chosen: the prediction is far off.
  [[nodiscard]] bool ExplainsTooLittle(bool masked) const noexcept {
    constexpr int kMinPercent = 20;
    int all = 0;
    int chosen = 0;
    for (int c = 0; c < surfaces_.components(); ++c) {
      const SurfaceVote& v = votes_[static_cast<std::size_t>(c)];
      const int pixels = masked ? v.masked : surfaces_.component(c).pixels;
      all += pixels;
      if (v.chosen) chosen += pixels;
    }
    return masked ? 100 * chosen < kMinPercent * all : chosen == 0;
  }

  /// Without the model's opinion: what the mask covers most of, or the largest surface.
  void ChooseUnexplained(bool masked) noexcept {
    int most = 0;
    for (int c = 0; c < surfaces_.components(); ++c) {
      const int pixels = surfaces_.component(c).pixels;
      if (masked) vote(c).chosen = 2 * vote(c).masked >= pixels;
      if (pixels > surfaces_.component(most).pixels) most = c;
    }
    if (!masked && surfaces_.components() > 0) vote(most).chosen = true;
  }

  /// Before a model exists: with a mask the largest surface within it, else the one under the seed
  /// pixel, else the nearest.
  [[nodiscard]] int ChooseFirst(const DepthFrame& frame,
                                const SegmenterConfig& config) const noexcept {
    const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
    const bool masked = frame.mask.given();
    if (!masked && config.seed_u_px >= 0 && config.seed_v_px >= 0)
      return surfaces_.ComponentAt(config.seed_u_px, config.seed_v_px);
    int best = Surfaces::kNoComponent;
    float best_score = 0.0F;
    for (int c = 0; c < surfaces_.components(); ++c) {
      const PixelRun& first = surfaces_.first_run(c);
      const float score = masked ? static_cast<float>(surfaces_.component(c).pixels)
                                 : 1.0F / std::max(depth.At(first.u_begin, first.v), 1e-3F);
      if (score <= best_score) continue;
      best_score = score;
      best = c;
    }
    return best;
  }

  /// Asks the model about every few points of a run.
  template <class Explains>
  static void Probe(const DepthReader& depth, const PinholeCamera& camera, Explains& explains,
                    const PixelRun& run, SurfaceVote& vote) noexcept {
    for (int u = run.u_begin + std::min(kProbeStepPx, run.length()) / 2; u < run.u_end;
         u += kProbeStepPx) {
      const float depth_m = depth.At(u, run.v);
      if (depth_m <= 0.0F) continue;
      ++vote.probed;
      if (explains(camera.BackProject(static_cast<float>(u), static_cast<float>(run.v), depth_m)))
        ++vote.explained;
    }
  }

  /// Whether the outline of the mask and that of the chosen surfaces are the same but for the
  /// pixels that a sensor loses along any outline. Takes away from the mask what is not chosen.
  [[nodiscard]] bool IsExact(Mask& mask) noexcept {
    int covered = 0;
    int outside = 0;
    PixelBox bounds{box_.u_max, box_.v_max, box_.u_min, box_.v_min};
    surfaces_.ForEachRun([&](int c, const PixelRun& run) {
      if (c == Surfaces::kNoComponent || !vote(c).chosen) return;
      const int inside = mask.row(run.v).CountRun(run.u_begin, run.u_end);
      covered += inside;
      outside += run.length() - inside;
      if (inside == 0) return;
      bounds.u_min = std::min(bounds.u_min, static_cast<int>(run.u_begin));
      bounds.u_max = std::max(bounds.u_max, static_cast<int>(run.u_end));
      bounds.v_min = std::min(bounds.v_min, static_cast<int>(run.v));
      bounds.v_max = std::max(bounds.v_max, static_cast<int>(run.v) + 1);
    });
    if (covered == 0) return false;
    const auto outline = 2.0F * static_cast<float>(bounds.width() + bounds.height());
    const auto lost = static_cast<float>(mask.count() - covered);
    return static_cast<float>(outside) < kOutsidePx * outline &&
           lost < kLostPx * outline + kLostShare * static_cast<float>(mask.count());
  }

  /// Draws the object anew from the chosen surfaces: those parts that the mask covers or the model
  /// explains.
  template <class Explains>
  void Redraw(const DepthFrame& frame, const ModelPrior& prior, Explains& explains,
              Mask& object) noexcept {
    const bool masked = frame.mask.given();
    const DepthReader depth(frame.depth, 0.0F, 1e6F);
    int v_done = 0;
    typename Mask::Row drawn;
    drawn.Clear();
    const auto flush = [&](int v) {
      for (; v_done < v; ++v_done) {
        object.row(v_done) = drawn;
        drawn.Clear();
      }
    };
    surfaces_.ForEachRun([&](int c, const PixelRun& run) {
      if (c == Surfaces::kNoComponent || !vote(c).chosen) return;
      flush(run.v);
      const auto& mask = object.row(run.v);
      const int inside = masked ? mask.CountRun(run.u_begin, run.u_end) : run.length();
      if (inside == run.length()) {
        drawn.SetRun(run.u_begin, run.u_end);
        return;
      }
      for (int u = run.u_begin; u < run.u_end; u += kProbeStepPx) {
        const int u_end = std::min(u + kProbeStepPx, static_cast<int>(run.u_end));
        SurfaceVote piece;
        if (mask.CountRun(u, u_end) < u_end - u && prior.known) {
          const PixelRun part{run.v, static_cast<std::int16_t>(u), static_cast<std::int16_t>(u_end),
                              0, 0};
          Probe(depth, frame.camera, explains, part, piece);
        }
        if (piece.explained > 0) {
          drawn.SetRun(u, u_end);
        } else {
          for (int i = u; i < u_end; ++i)
            if (mask.Test(i)) drawn.SetRun(i, i + 1);
        }
      }
    });
    flush(object.height_px());
    object.Finish();
    object.template Close<kClosingPx>();
  }

  [[nodiscard]] SurfaceVote& vote(int component) noexcept {
    return votes_[static_cast<std::size_t>(component)];
  }

  static constexpr int kProbeStepPx = 8;
  static constexpr int kClosingPx = 2;
  static constexpr float kOutsidePx = 0.5F;
  static constexpr float kLostPx = 1.5F;
  static constexpr float kLostShare = 0.02F;

  Surfaces surfaces_;
  PlaneRemoval planes_;
  PixelBox box_;
  std::array<SurfaceVote, static_cast<std::size_t>(Surfaces::kMaxComponents)> votes_;
};

}  // namespace disflow
