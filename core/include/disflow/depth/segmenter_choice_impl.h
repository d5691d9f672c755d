// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/depth/model_gate.h"
#include "disflow/depth/segmenter.h"

/// @file
/// Definitions of Segmenter's members that decide which surfaces are the object; apart, so that
/// tracker.h stays light.

namespace disflow {

/// visit(number of the component or kNoComponent, u, v) for the pixels of all runs that have no run
/// above them, or below.
/// @param v_step -1 or 1.
template <class Row, class Surfaces, class Visitor>
void ForEachColumnEnd(const Surfaces& surfaces, int v_step, Visitor&& visit) noexcept {
  Row next{};  // Of the row that is a step ahead.
  Row row{};
  int v = -1;
  surfaces.ForEachRun(
      [&](int c, const PixelRun& run) {
        if (run.v != v) {
          next = row;
          if (run.v + v_step != v) next.Clear();
          row.Clear();
          v = run.v;
        }
        row.SetRun(run.u_begin, run.u_end);
        next.ForEachGap(run.u_begin, run.u_end, [&](int u_begin, int u_end) {
          for (int u = u_begin; u < u_end; ++u) visit(c, u, v);
        });
      },
      v_step > 0);
}

template <class Limits>
template <class Explains>
void Segmenter<Limits>::Look(const Manner& manner, const DepthFrame& frame,
                             const SegmenterConfig& config, const ModelPrior& prior,
                             Explains& explains, const Mask& mask) noexcept {
  manner_ = manner;
  BuildSurfaces(frame, config, prior, mask);
  votes_ = {};
  for (int c = 0; c < surfaces_.components(); ++c) vote(c).pixels = surfaces_.component(c).pixels;
  if (!frame.mask.given()) FindEnds(frame, config, prior);
  ChooseSurfaces(frame, config, prior, explains, mask);
}

/// A thing that stands on a table or leans against a wall is one surface with it, which goes on
/// where the object cannot be. Surfaces are then cut where they fold towards the camera.
template <class Limits>
template <class Explains>
std::uint32_t Segmenter<Limits>::LookAround(const DepthFrame& frame, const SegmenterConfig& config,
                                            const ModelPrior& prior, Explains& explains,
                                            Mask& object) noexcept {
  const auto goes_on = [&](const Manner& manner) {
    Look(manner, frame, config, prior, explains, object);
    return ObjectGoesOn();
  };
  const auto draw = [&] {
    Redraw(frame, prior, explains, object);
    return static_cast<std::uint32_t>(surfaces_.dropped());
  };
  const float far = prior.known ? kFarMargins : 1.0F;
  if (!prior.known || !prior.contact.touches) {
    if (!goes_on({})) return draw();
    if (prior.known) {
      // As it moves it may have reached out of the margin, or shows a new face, no more. Drawn now,
      // since looking again forgets what was seen.
      const std::uint32_t dropped = draw();
      if (!goes_on({.margins = far, .whole_face = true})) return dropped;
    }
  }
  contact_.touches = goes_on({.margins = far, .cut = true});
  if (prior.known && !prior.doubtful) {
    // A body as long as its bounds that turns about its long axis shows a strip as wide as the turn
    // times its depth: of a thing that was held edge-on, two images may show a quarter anew.
    const float half_diagonal_m = 0.5F * (prior.box_max_m - prior.box_min_m).norm();
    const float strip_m = prior.contact.turned_rad * kFacePerSize * half_diagonal_m;
    const float away_m = std::max(prior.T_oc.Inverse().translation().z(), half_diagonal_m);
    const float step_m = static_cast<float>(kProbeStepPx) * away_m / frame.camera.fx_px;
    const float most_new = strip_m * 2.0F * half_diagonal_m / (step_m * step_m);
    contact_.merged = !ChooseOfCut(votes_.data(), surfaces_.components(), most_new);
    if (contact_.merged) contact_.turned_rad = prior.contact.turned_rad;
  }
  return draw();
}

template <class Limits>
bool Segmenter<Limits>::ObjectGoesOn() noexcept {
  for (int c = 0; c < surfaces_.components(); ++c) {
    const bool candidate = manner_.cut || vote(c).chosen || vote(c).explained > 0;
    if (candidate && GoesOn(vote(c))) return true;
  }
  return false;
}

template <class Limits>
void Segmenter<Limits>::FindEnds(const DepthFrame& frame, const SegmenterConfig& config,
                                 const ModelPrior& prior) noexcept {
  const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
  const ModelGate gate = GateOf(frame, config, prior);
  // A fold beside the border, with what lies in it, ends no surface: noise makes such folds.
  const int border_px = !prior.known && manner_.cut ? 2 * valleys_.reach_px() : 0;
  const auto is_outside = [this](int u, int v, int px) {
    return u < box_.u_min + px || u >= box_.u_max - px || v < box_.v_min + px ||
           v >= box_.v_max - px;
  };
  const auto goes_on = [&](int u, int v, int u_beyond, int v_beyond) {
    const float here_m = depth.At(u, v);
    float beyond_m = depth.AtOrZero(u_beyond, v_beyond);
    if (beyond_m <= 0.0F) return !prior.known && is_outside(u_beyond, v_beyond, 0);
    if (std::abs(beyond_m - here_m) > config.depth_jump_ratio * std::min(here_m, beyond_m))
      return false;
    planes_(v_beyond, u_beyond, u_beyond + 1, &beyond_m);
    if (beyond_m <= 0.0F) return false;
    if (!prior.known) return is_outside(u_beyond, v_beyond, border_px);
    return !gate.Accepts(frame.camera.BackProject(static_cast<float>(u_beyond),
                                                  static_cast<float>(v_beyond), beyond_m));
  };
  surfaces_.ForEachRun([&](int c, const PixelRun& run) {
    if (c == Surfaces::kNoComponent) return;
    vote(c).outline += 2;
    vote(c).ends += int{goes_on(run.u_begin, run.v, run.u_begin - 1, run.v)} +
                    int{goes_on(run.u_end - 1, run.v, run.u_end, run.v)};
  });
  // An arm that holds the object from below goes on from one row to the next.
  for (const int v_step : {-1, 1}) {
    ForEachColumnEnd<typename Mask::Row>(surfaces_, v_step, [&](int c, int u, int v) {
      if (c == Surfaces::kNoComponent) return;
      ++vote(c).outline;
      vote(c).ends += int{goes_on(u, v, u, v + v_step)};
    });
  }
}

template <class Limits>
template <class Explains>
void Segmenter<Limits>::ChooseSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                                       const ModelPrior& prior, Explains& explains,
                                       const Mask& mask) noexcept {
  const int count = surfaces_.components();
  if (frame.mask.given()) {
    ChooseMasked(frame, config, prior, explains, mask);
    return;
  }
  if (!prior.known) {
    // Crumbs of noise come and go; what is large stays.
    const bool take_largest = prior.nearest_in_vain && config.seed_u_px < 0;
    const int first =
        take_largest ? LargestThatEnds(votes_.data(), count) : ChooseFirst(frame, config);
    if (first < count) vote(first).chosen = true;
    return;
  }
  // A single surface needs no asking, unless it may be more than the object.
  if ((count != 1 || manner_.cut) && !prior.doubtful) {
    const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
    surfaces_.ForEachRun([&](int c, const PixelRun& run) {
      if (c != Surfaces::kNoComponent && run.v % kProbeStepPx == 0)
        Probe(depth, frame.camera, explains, run, vote(c));
    });
  }
  for (int c = 0; c < count; ++c) vote(c).chosen = !prior.doubtful && BelongsToObject(vote(c));
  ChooseLargestInsteadOfCrumbs(votes_.data(), count);
}

template <class Limits>
template <class Explains>
void Segmenter<Limits>::ChooseMasked(const DepthFrame& frame, const SegmenterConfig& config,
                                     const ModelPrior& prior, Explains& explains,
                                     const Mask& mask) noexcept {
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
    v.chosen = BelongsToMaskedObject(v);
    all_pixels += v.masked;
    if (v.chosen) chosen_pixels += v.masked;
    if (v.masked > vote(most).masked) most = c;
  }
  // Next to nothing of what the mask covers: the prediction is far off, or the object is one
  // surface with what it stands on and there is no model yet.
  constexpr int kMinPercent = 20;
  if (count > 0 && 100 * chosen_pixels < kMinPercent * all_pixels) vote(most).chosen = true;
}

template <class Limits>
int Segmenter<Limits>::ChooseFirst(const DepthFrame& frame,
                                   const SegmenterConfig& config) noexcept {
  const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
  if (config.seed_u_px >= 0 && config.seed_v_px >= 0)
    return surfaces_.ComponentAt(config.seed_u_px, config.seed_v_px,
                                 std::max(config.seed_reach_px, valleys_.reach_px()));
  const auto nearest = [&](const auto& may_be) {
    int best = Surfaces::kNoComponent;
    float best_m = 0.0F;
    for (int c = 0; c < surfaces_.components(); ++c) {
      const PixelRun& first = surfaces_.first_run(c);
      const float depth_m = depth.At(first.u_begin, first.v);
      if (!may_be(c) || (best != Surfaces::kNoComponent && depth_m >= best_m)) continue;
      best_m = depth_m;
      best = c;
    }
    return best;
  };
  // Of a table that noise hides in part ragged pieces are left, some nearer than what stands there.
  const auto solid = [&](int c) { return !IsRagged(vote(c)); };
  int first = nearest(solid);
  if (first == Surfaces::kNoComponent) first = nearest([](int) { return true; });
  // Who draws a region may draw it too tightly; there the nearest is what was meant.
  const bool whole_image =
      box_.width() == frame.depth.width_px && box_.height() == frame.depth.height_px;
  if (!manner_.cut || !whole_image || first == Surfaces::kNoComponent) return first;
  // An arm that reaches into the image is often nearer than what is to be tracked.
  const int pixels = vote(first).pixels;
  const int ends = nearest([&](int c) {
    return solid(c) && !GoesOn(vote(c)) && 100 * vote(c).pixels >= kCrumbPercent * pixels;
  });
  return ends == Surfaces::kNoComponent ? first : ends;
}

}  // namespace disflow
