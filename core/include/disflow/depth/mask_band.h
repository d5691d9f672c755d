// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/config.h"
#include "disflow/depth/depth_reader.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/geometry/pinhole_camera.h"

namespace disflow {

/// The dilation of a mask by a square of (2 radius + 1) pixels. A step of n pixels reaches all in
/// between as well once n - 1 are filled, so that steps may double.
/// @param source After Finish().
/// @param out Another mask; started anew and finished.
template <class Mask>
void Dilate(const Mask& source, int radius_px, Mask& out) noexcept {
  out.Start(source.width_px(), source.height_px());
  const PixelBox& box = source.box();
  if (!box.empty()) {
    const int w_begin = std::max(box.u_min - radius_px, 0) / Mask::kBits;
    const int w_end =
        (std::min(box.u_max + radius_px, source.width_px()) + Mask::kBits - 1) / Mask::kBits;
    const int v_begin = std::max(box.v_min - radius_px, 0);
    const int v_end = std::min(box.v_max + radius_px, source.height_px());
    const auto add = [&](int v, int v_from) {
      for (int w = w_begin; w < w_end; ++w) out.row(v)[w] |= out.row(v_from)[w];
    };
    for (int v = box.v_min; v < box.v_max; ++v) {
      auto& bits = out.row(v);
      for (int w = w_begin; w < w_end; ++w) bits[w] = source.row(v)[w];
      for (int reached = 0; reached < radius_px;) {
        const int step = std::min({reached + 1, radius_px - reached, Mask::kBits - 1});
        bits.Spread(w_begin, w_end, step);
        reached += step;
      }
    }
    for (int reached = 0; reached < radius_px;) {
      const int step = std::min(reached + 1, radius_px - reached);
      // Each row from one that this step has not changed yet.
      for (int v = v_end - 1; v >= v_begin + step; --v) add(v, v - step);
      for (int v = v_begin; v < v_end - step; ++v) add(v, v + step);
      reached += step;
    }
  }
  out.Finish();
}

/// In metres along the ray per metre across it: that of the flattest surface that is sampled
/// (sampler.min_cos_incidence).
inline constexpr float kMostSlope = 8.0F;

/// Where the object's surfaces go on beyond the tolerance of a given mask.
template <class Mask>
struct MaskOverrun {
  Mask pixels;
  int reach_px = 0;  ///< From a pixel beyond the tolerance to one that is the object for sure.

  void Start(int width_px, int height_px) noexcept {
    pixels.Start(width_px, height_px);
    reach_px = 0;
  }

  /// Whether the surface at a pixel may go on to beyond the tolerance, as an object's foot does
  /// onto its table: whether there is such surface nearby, in space and not only in the image.
  /// There only the mask, which may be off by its tolerance, says where the object ends.
  [[nodiscard]] bool IsReachedFrom(int u, int v, const DepthReader& depth,
                                   const PinholeCamera& camera) const noexcept {
    const float here_m = depth.AtOrZero(u, v);
    if (pixels.count() == 0 || here_m <= 0.0F) return false;
    const float rise_m = kMostSlope * here_m / camera.fx_px;
    for (int step = 1; step <= reach_px; ++step) {
      for (int k = 0; k < 9; ++k) {
        const int u_there = u + step * (k % 3 - 1);
        const int v_there = v + step * (k / 3 - 1);
        if (!pixels.Test(u_there, v_there)) continue;
        const float there_m = depth.AtOrZero(u_there, v_there);
        if (std::abs(there_m - here_m) <= rise_m * static_cast<float>(step)) return true;
      }
    }
    return false;
  }
};

/// A given mask is a promise with a tolerance. Inside of it the depth image and the model may
/// object; outside of it they may add, but only within the tolerance.
template <class Mask>
class MaskBand {
 public:
  /// @param motion_px How far the object may have moved in the image since the mask was made.
  void Start(const Mask& given, const SegmenterConfig& config, float motion_px) noexcept {
    const float wanted_px = static_cast<float>(config.mask_tolerance_px) + motion_px;
    tolerance_px_ =
        static_cast<int>(std::lround(std::clamp(wanted_px, 0.0F, float{kMostTolerance_px})));
    Dilate(given, tolerance_px_, allowed_);
  }

  [[nodiscard]] int tolerance_px() const noexcept { return tolerance_px_; }
  /// What the tolerance allows of an image row.
  [[nodiscard]] const typename Mask::Row& AllowedIn(int v) const noexcept {
    return allowed_.row(v);
  }

  /// Around the given mask, as far as surface says anything of the object: within the tolerance,
  /// and beyond it so far that surface which goes on is seen to. What starts farther out is not the
  /// surface at the outline.
  [[nodiscard]] PixelBox BoxThatMatters(const Mask& given) const noexcept {
    const int margin_px = tolerance_px_ + kBeyond_px;
    return {std::max(given.box().u_min - margin_px, 0), std::max(given.box().v_min - margin_px, 0),
            std::min(given.box().u_max + margin_px, given.width_px()),
            std::min(given.box().v_max + margin_px, given.height_px())};
  }

  /// Takes away what lies beyond the tolerance.
  void Restrict(Mask& object) const noexcept {
    for (int v = object.box().v_min; v < object.box().v_max; ++v) {
      for (int w = 0; w < object.words(); ++w) object.row(v)[w] &= allowed_.row(v)[w];
    }
  }

  /// @param for_each_run for_each_run(visit): visit(v, u_begin, u_end) for every run of pixels of
  /// the object's surfaces.
  /// @param overrun After Start().
  template <class ForEachRun>
  void FindOverrun(ForEachRun&& for_each_run, MaskOverrun<Mask>& overrun) const noexcept {
    for_each_run(
        [&](int v, int u_begin, int u_end) { overrun.pixels.row(v).SetRun(u_begin, u_end); });
    for (int v = 0; v < allowed_.height_px(); ++v) {
      for (int w = 0; w < allowed_.words(); ++w) overrun.pixels.row(v)[w] &= ~allowed_.row(v)[w];
    }
    overrun.pixels.Finish();
    overrun.reach_px = reach_px();
  }

 private:
  /// From the band's outer border across the mask's outline, and as far again.
  [[nodiscard]] int reach_px() const noexcept { return 2 * tolerance_px_ + 1; }

  /// So wide that a walk from pixel to pixel (MaskOverrun::IsReachedFrom) meets surface that goes
  /// on, also where some pixels have no depth. Real recordings are followed as well with 8.
  static constexpr int kBeyond_px = 16;
  static constexpr int kMostTolerance_px = 64;

  Mask allowed_;
  int tolerance_px_ = 0;
};

}  // namespace disflow
