// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "disflow/depth/model_gate.h"
#include "disflow/depth/pixel_runs_impl.h"
#include "disflow/depth/segmenter.h"
#include "disflow/depth/valley_cut_impl.h"

/// @file
/// Definitions of Segmenter's members that cut the image into surfaces and draw those chosen;
/// apart, so that tracker.h stays light.

namespace disflow {

template <class Limits>
template <class Explains>
Status Segmenter<Limits>::Segment(const DepthFrame& frame, const SegmenterConfig& config,
                                  const ModelPrior& prior, Explains&& explains, Mask& object,
                                  MaskOverrun<Mask>& overrun, Counters& counters) noexcept {
  object.Start(frame.depth.width_px, frame.depth.height_px);
  overrun.Start(frame.depth.width_px, frame.depth.height_px);
  contact_ = {};
  elsewhere_ = false;
  if (frame.mask.given()) {
    for (int v = 0; v < frame.mask.height_px; ++v)
      object.SetFromBytes(v, 0, frame.mask.width_px, frame.mask.row(v), frame.mask.label);
    object.Finish();
    if (object.count() == 0) return Status::kEmptyMask;
    band_.Start(object, config, prior.motion_px);
  }
  if (!frame.mask.given() && config.grow_region == 0) {
    // The range gate drops what is too far pixel by pixel.
    const PixelBox box = RegionOfInterest(frame, config);
    for (int v = box.v_min; v < box.v_max; ++v) object.row(v).SetRun(box.u_min, box.u_max);
  } else {
    if (frame.mask.given()) {
      Look({}, frame, config, prior, explains, object);
      counters.runs_dropped += static_cast<std::uint32_t>(surfaces_.dropped());
      Redraw(frame, prior, explains, object);
    } else if (prior.anywhere && LookAnywhere(frame, config, prior, explains, object)) {
      counters.runs_dropped += static_cast<std::uint32_t>(surfaces_.dropped());
    } else {
      counters.runs_dropped += LookAround(frame, config, prior, explains, object);
    }
  }
  if (frame.mask.given()) {
    band_.Restrict(object);
    band_.FindOverrun([this](const auto& visit) { this->ForEachChosenRun(visit); }, overrun);
  }
  object.Finish();
  return object.count() > 0 ? Status::kOk : Status::kNoValidDepth;
}

template <class Limits>
template <class Explains>
void Segmenter<Limits>::Probe(const DepthReader& depth, const PinholeCamera& camera,
                              Explains& explains, const PixelRun& run, SurfaceVote& vote) noexcept {
  for (int u = run.u_begin + std::min(kProbeStepPx, run.length()) / 2; u < run.u_end;
       u += kProbeStepPx) {
    ProbePixel(depth, camera, explains, u, run.v, vote);
  }
}

template <class Limits>
template <class Explains>
void Segmenter<Limits>::ProbePixel(const DepthReader& depth, const PinholeCamera& camera,
                                   Explains& explains, int u, int v, SurfaceVote& vote) noexcept {
  const float depth_m = depth.At(u, v);
  if (depth_m <= 0.0F) return;
  ++vote.probed;
  if (explains(camera.BackProject(static_cast<float>(u), static_cast<float>(v), depth_m)))
    ++vote.explained;
}

template <class Limits>
template <class Explains>
void Segmenter<Limits>::ProbeMasked(const DepthReader& depth, const PinholeCamera& camera,
                                    Explains& explains, const PixelRun& run, const Mask& mask,
                                    SurfaceVote& vote) noexcept {
  constexpr int kOffset = kProbeStepPx / 2;
  const int first = (run.u_begin - kOffset + kProbeStepPx - 1) / kProbeStepPx;
  for (int u = first * kProbeStepPx + kOffset; u < run.u_end; u += kProbeStepPx) {
    if (mask.row(run.v).Test(u)) ProbePixel(depth, camera, explains, u, run.v, vote);
  }
}

template <class Limits>
void Segmenter<Limits>::BuildSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                                      const ModelPrior& prior, const Mask& mask) noexcept {
  const DepthReader depth(frame.depth, config.min_range_m, config.max_range_m);
  const bool masked = frame.mask.given();
  planes_.Clear();
  valleys_.Clear();
  if (!prior.known && !masked) {
    BuildFirstSurfaces(frame, config, depth);
  } else if (!prior.known) {
    box_ = band_.BoxThatMatters(mask);
    Connect(frame, config, depth, kMinPixels, [](int, int, int, float*) {});
  } else {
    const ModelGate gate = GateOf(frame, config, prior);
    box_ = gate.SearchBox(config.min_range_m, {0, 0, frame.depth.width_px, frame.depth.height_px});
    if (masked) {
      box_ = Common(box_, band_.BoxThatMatters(mask));
    } else {
      planes_.Find(depth, box_, [&](int u, int v, float depth_m) {
        return !gate.Accepts(
            frame.camera.BackProject(static_cast<float>(u), static_cast<float>(v), depth_m));
      });
    }
    if (manner_.cut)
      valleys_.Start(depth, frame.camera, box_, prior.T_oc.Inverse().translation().z());
    Connect(frame, config, depth, kMinPixels, gate);
  }
}

/// Without a mask, before there is a model.
template <class Limits>
void Segmenter<Limits>::BuildFirstSurfaces(const DepthFrame& frame, const SegmenterConfig& config,
                                           const DepthReader& depth) noexcept {
  box_ = RegionOfInterest(frame, config);
  if (manner_.cut) {
    const float seed_m = depth.AtOrZero(config.seed_u_px, config.seed_v_px);
    valleys_.Start(depth, frame.camera, box_, seed_m);
  }
  planes_.Find(depth, Surroundings(box_, frame), [](int, int, float) { return true; });
  const auto connect = [&] {
    const int fewest_pixels = std::max(64, box_.width() * box_.height() / 2000);
    Connect(frame, config, depth, fewest_pixels, [](int, int, int, float*) {});
  };
  connect();
  if (surfaces_.components() > 0) return;
  planes_.Clear();  // There is nothing else: one of them is the object's own.
  connect();
}

/// Connects the pixels of the box that a gate, planes and valleys leave. Coarse images of steep
/// surface have larger steps in depth than fine ones; but without a mask what lies close behind the
/// object would be joined with it.
template <class Limits>
template <class Gate>
void Segmenter<Limits>::Connect(const DepthFrame& frame, const SegmenterConfig& config,
                                const DepthReader& depth, int fewest_pixels,
                                const Gate& gate) noexcept {
  const float steepest = frame.mask.given() ? kMostSlope / frame.camera.fx_px : 0.0F;
  surfaces_.Build(
      depth, box_, std::max(config.depth_jump_ratio, steepest), fewest_pixels,
      [&](int v, int u_begin, int u_end, float* depth_m) {
        gate(v, u_begin, u_end, depth_m);
        planes_(v, u_begin, u_end, depth_m);
        valleys_(depth, v, u_begin, u_end, depth_m);
      },
      // A valley is no gap in the sensor's data.
      valleys_.empty() ? kBridgedGapPx : 0);
}

template <class Limits>
ModelGate Segmenter<Limits>::GateOf(const DepthFrame& frame, const SegmenterConfig& config,
                                    const ModelPrior& prior) const noexcept {
  const float factor = frame.mask.given() ? kMaskMarginFactor : manner_.margins;
  const float off_m = std::min(config.velocity_change_mps * prior.unseen_s, config.lost_margin_m);
  // Of a body that was seen from few sides nobody knows how deep it is, likely in proportion to
  // what was seen: so much may come into view at once.
  const float half_diagonal_m = 0.5F * (prior.box_max_m - prior.box_min_m).norm();
  const float face_m = manner_.whole_face ? kFacePerSize * half_diagonal_m : 0.0F;
  const float margin_m = std::max(factor * config.model_margin_m, face_m);
  if (prior.doubtful) return {frame.camera, prior, margin_m + off_m};
  return {frame.camera, prior, std::max(margin_m, factor * off_m)};
}

template <class Limits>
template <class Explains>
void Segmenter<Limits>::Redraw(const DepthFrame& frame, const ModelPrior& prior, Explains& explains,
                               Mask& object) noexcept {
  const bool masked = frame.mask.given();
  // What a cut leaves may still go on a little where the object ends.
  const bool near_known_only = manner_.cut && prior.known && !prior.doubtful;
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
    const int inside = masked            ? mask.CountRun(run.u_begin, run.u_end)
                       : near_known_only ? 0
                                         : run.length();
    if (inside == run.length()) {
      drawn.SetRun(run.u_begin, run.u_end);
      return;
    }
    if (masked) drawn.AddRun(mask, run.u_begin, run.u_end);
    for (int u = run.u_begin; u < run.u_end && prior.known; u += kProbeStepPx) {
      const int u_end = std::min(u + kProbeStepPx, static_cast<int>(run.u_end));
      if (masked && mask.CountRun(u, u_end) == u_end - u) continue;
      const PixelRun part{run.v, static_cast<std::int16_t>(u), static_cast<std::int16_t>(u_end), 0,
                          0};
      SurfaceVote piece;
      Probe(depth, frame.camera, explains, part, piece);
      if (piece.explained == 0) continue;
      if (masked) {
        drawn.AddRun(band_.AllowedIn(run.v), u, u_end);
      } else {
        drawn.SetRun(u, u_end);
      }
    }
  });
  flush(object.height_px());
  object.Finish();
  object.template Close<kClosingPx>();
}

}  // namespace disflow
