// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "disflow/config.h"
#include "disflow/depth/depth_frame.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/mask_band.h"
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

/// Whether a surface is the object's, once there is a model and without a mask.
[[nodiscard]] bool BelongsToObject(const SurfaceVote& vote) noexcept;

/// The same under a mask; the model was only asked about what the mask covers.
/// @param pixels Of the surface, the part outside of the mask included.
[[nodiscard]] bool BelongsToMaskedObject(const SurfaceVote& vote, int pixels) noexcept;

/// The part of the image that the settings leave.
[[nodiscard]] PixelBox RegionOfInterest(const DepthFrame& frame,
                                        const SegmenterConfig& config) noexcept;

/// The region and half of it more on every side: what a table does beyond the region tells it from
/// a face that ends there, even if the region is drawn too tightly.
[[nodiscard]] PixelBox Surroundings(const PixelBox& region, const DepthFrame& frame) noexcept;

/// Decides which pixels are the object. The depth image is cut into connected surfaces within reach
/// of the predicted model (or, before there is a model, within range and region of interest); the
/// model and the mask, if one is given, say which of them are the object. A given mask is believed
/// within its tolerance, see mask_band.h.
template <class Limits>
class Segmenter {
 public:
  using Mask = PixelMask<Limits::kMaxImageWidth, Limits::kMaxImageHeight>;

  /// @param explains explains(x_c): whether known surface of the predicted model is near a point of
  /// the camera frame. Only called if prior.known.
  /// @param overrun Where the object's surfaces go on beyond the mask's tolerance. Empty without a
  /// mask.
  template <class Explains>
  [[nodiscard]] Status Segment(const DepthFrame& frame, const SegmenterConfig& config,
                               const ModelPrior& prior, Explains&& explains, Mask& object,
                               MaskOverrun<Mask>& overrun, Counters& counters) noexcept {
    object.Start(frame.depth.width_px, frame.depth.height_px);
    overrun.Start(frame.depth.width_px, frame.depth.height_px);
    if (frame.mask.given()) {
      const PixelBox image{0, 0, frame.mask.width_px, frame.mask.height_px};
      CopyMask(frame.mask, image, object);
      if (object.count() == 0) return Status::kEmptyMask;
      band_.Start(object, config, prior.motion_px);
    }
    if (!frame.mask.given() && config.grow_region == 0) {
      TakeAll(frame, config, object);
    } else {
      BuildSurfaces(frame, config, prior, object, counters);
      ChooseSurfaces(frame, config, prior, explains, object);
      if (!frame.mask.given() || !IsExact(object)) Redraw(frame, prior, explains, object);
    }
    if (frame.mask.given()) {
      band_.Restrict(object);
      band_.FindOverrun([this](const auto& visit) { this->ForEachChosenRun(visit); }, overrun);
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
    if (frame.mask.given()) {
      ChooseMasked(frame, config, prior, explains, mask);
      return;
    }
    if (!prior.known) {
      const int first = ChooseFirst(frame, config);
      if (first < count) vote(first).chosen = true;
      return;
    }
    // A single surface needs no asking.
    if (count != 1 && !prior.doubtful) {
      const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
      surfaces_.ForEachRun([&](int c, const PixelRun& run) {
        if (c != Surfaces::kNoComponent && run.v % kProbeStepPx == 0)
          Probe(depth, frame.camera, explains, run, vote(c));
      });
    }
    int largest = 0;
    bool any = false;
    for (int c = 0; c < count; ++c) {
      vote(c).chosen = !prior.doubtful && BelongsToObject(vote(c));
      any = any || vote(c).chosen;
      if (surfaces_.component(c).pixels > surfaces_.component(largest).pixels) largest = c;
    }
    // The prediction is far off.
    if (!any && count > 0) vote(largest).chosen = true;
  }

  /// Under a mask. What the mask covers of a surface counts, however far it goes on outside: an
  /// object that touches its table is one surface with it.
  template <class Explains>
  void ChooseMasked(const DepthFrame& frame, const SegmenterConfig& config, const ModelPrior& prior,
                    Explains& explains, const Mask& mask) noexcept {
    const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
    surfaces_.ForEachRun([&](int c, const PixelRun& run) {
      if (c == Surfaces::kNoComponent) return;
      vote(c).masked += mask.row(run.v).CountRun(run.u_begin, run.u_end);
      if (prior.known && run.v % kProbeStepPx == 0)
        ProbeMasked(depth, frame.camera, explains, run, mask, vote(c));
    });
    const int count = surfaces_.components();
    int most = 0;
    int all_pixels = 0;
    int chosen_pixels = 0;
    for (int c = 0; c < count; ++c) {
      SurfaceVote& v = vote(c);
      v.chosen = BelongsToMaskedObject(v, surfaces_.component(c).pixels);
      all_pixels += v.masked;
      if (v.chosen) chosen_pixels += v.masked;
      if (v.masked > vote(most).masked) most = c;
    }
    // Next to nothing of what the mask covers: the prediction is far off, or the object is one
    // surface with what it stands on and there is no model yet.
    constexpr int kMinPercent = 20;
    if (count > 0 && 100 * chosen_pixels < kMinPercent * all_pixels) vote(most).chosen = true;
  }

  /// Before a model exists and without a mask: what lies under the seed pixel, or the nearest.
  [[nodiscard]] int ChooseFirst(const DepthFrame& frame,
                                const SegmenterConfig& config) const noexcept;

  /// Asks the model about every few points of a run.
  template <class Explains>
  static void Probe(const DepthReader& depth, const PinholeCamera& camera, Explains& explains,
                    const PixelRun& run, SurfaceVote& vote) noexcept {
    for (int u = run.u_begin + std::min(kProbeStepPx, run.length()) / 2; u < run.u_end;
         u += kProbeStepPx) {
      ProbePixel(depth, camera, explains, u, run.v, vote);
    }
  }

  template <class Explains>
  static void ProbePixel(const DepthReader& depth, const PinholeCamera& camera, Explains& explains,
                         int u, int v, SurfaceVote& vote) noexcept {
    const float depth_m = depth.At(u, v);
    if (depth_m <= 0.0F) return;
    ++vote.probed;
    if (explains(camera.BackProject(static_cast<float>(u), static_cast<float>(v), depth_m)))
      ++vote.explained;
  }

  /// The same, of what the mask covers: on a grid over the image, so that runs of any length count
  /// alike.
  template <class Explains>
  static void ProbeMasked(const DepthReader& depth, const PinholeCamera& camera, Explains& explains,
                          const PixelRun& run, const Mask& mask, SurfaceVote& vote) noexcept {
    constexpr int kOffset = kProbeStepPx / 2;
    const int first = (run.u_begin - kOffset + kProbeStepPx - 1) / kProbeStepPx;
    for (int u = first * kProbeStepPx + kOffset; u < run.u_end; u += kProbeStepPx) {
      if (mask.row(run.v).Test(u)) ProbePixel(depth, camera, explains, u, run.v, vote);
    }
  }

  /// visit(v, u_begin, u_end)
  template <class Visitor>
  void ForEachChosenRun(const Visitor& visit) noexcept {
    surfaces_.ForEachRun([&](int c, const PixelRun& run) {
      if (c != Surfaces::kNoComponent && vote(c).chosen) visit(run.v, run.u_begin, run.u_end);
    });
  }

  /// Whether the outline of the mask and that of the chosen surfaces are the same but for the
  /// pixels that a sensor loses along any outline.
  [[nodiscard]] bool IsExact(Mask& mask) noexcept;

  /// Draws the object anew from the chosen surfaces: those parts that the mask covers, or that the
  /// model explains and the mask's tolerance allows.
  template <class Explains>
  void Redraw(const DepthFrame& frame, const ModelPrior& prior, Explains& explains,
              Mask& object) noexcept;

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
  MaskBand<Mask> band_;
  PixelBox box_;
  std::array<SurfaceVote, static_cast<std::size_t>(Surfaces::kMaxComponents)> votes_;
};

}  // namespace disflow
