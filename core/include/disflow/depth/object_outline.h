// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/depth/depth_frame.h"
#include "disflow/depth/outline.h"
#include "disflow/depth/outline_scale.h"

namespace disflow {

/// Where the object ends in the image. The depth's own outline is ragged and too wide on cameras
/// that match windows of pixels. A given mask knows better if it is exact, which shows: on the
/// whole it ends where the depth does.
template <int kMaxPoints>
class ObjectOutline {
 public:
  using Points = FixedVector<OutlinePoint, kMaxPoints>;

  /// @param object All of the object's pixels, not eroded.
  /// @param given The user's mask, if there is one.
  template <class Mask>
  void Find(const Mask& object, const MaskView& given) noexcept {
    points_.clear();
    Collect(object);
    depth_std_px_ = NoiseOf(object);
    std_px_ = depth_std_px_;
    source_ = given.given() && IsExact(given) ? OutlineSource::kMask : OutlineSource::kDepth;
    if (source_ == OutlineSource::kDepth) return;
    TakeFrom(given);
    std_px_ = NoiseOf(given);
  }

  [[nodiscard]] const Points& points() const noexcept { return points_; }
  /// Noise of the points' place across the outline.
  [[nodiscard]] float std_px() const noexcept { return std_px_; }
  /// The same of the depth's outline.
  [[nodiscard]] float depth_std_px() const noexcept { return depth_std_px_; }
  /// Whose outline the points are on.
  [[nodiscard]] OutlineSource source() const noexcept { return source_; }

 private:
  /// How far a mask is looked for from the depth's outline.
  static constexpr int kReachPx = kMatchingReachPx + 1;

  template <class Mask, class Visitor>
  static void ForEachPixel(const Mask& object, Visitor&& visit) noexcept {
    for (int v = object.box().v_min; v < object.box().v_max; ++v)
      object.ForEachOutlineInRow(v, [&](int u) { visit(u, v); });
  }

  /// Two passes: count the outline, then take every k-th of its points, so that the whole outline
  /// is represented.
  template <class Mask>
  void Collect(const Mask& object) noexcept {
    int outline = 0;
    ForEachPixel(object, [&outline](int, int) { ++outline; });
    // Steps of the golden ratio: a regular stride would, row by row, meet the left outline alone.
    constexpr float kGoldenRatio = 0.61803399F;
    const float share =
        static_cast<float>(kMaxPoints) / static_cast<float>(std::max(outline, kMaxPoints));
    float phase = 0.0F;
    ForEachPixel(object, [&](int u, int v) {
      phase += kGoldenRatio;
      phase -= std::floor(phase);
      OutlinePoint point;
      if (phase < share && FitOutline(object, u, v, point)) (void)points_.push_back(point);
    });
  }

  template <class Mask>
  [[nodiscard]] float NoiseOf(const Mask& mask) const noexcept {
    OutlineNoise<kMaxPoints> noise;
    // Every second one: the median of half as many is as good, and this is a part of the frame's
    // time that shows.
    for (int i = 0; i < points_.size(); i += 2) noise.Add(mask, points_[i]);
    return noise.std_px();
  }

  /// Nearly everywhere near the depth's outline, and half of it within a pixel, outside or inside.
  [[nodiscard]] bool IsExact(const MaskView& given) const noexcept {
    constexpr float kMostMissed = 0.1F;
    int inside = 0;
    int outside = 0;
    int missed = 0;
    for (const OutlinePoint& point : points_) {
      int offset_px = 0;
      if (!FindOutline<kReachPx>(given, point.pixel, point.inward, offset_px)) {
        ++missed;
      } else if (offset_px > 1) {
        ++inside;
      } else if (offset_px < -1) {
        ++outside;
      }
    }
    const int found = points_.size() - missed;
    return found > 0 && static_cast<float>(missed) <= kMostMissed * static_cast<float>(found) &&
           2 * std::max(inside, outside) < found;
  }

  /// Moves the points to the mask's outline.
  void TakeFrom(const MaskView& given) noexcept {
    int kept = 0;
    for (int i = 0; i < points_.size(); ++i) {
      int offset_px = 0;
      const OutlinePoint& point = points_[i];
      if (!FindOutline<kReachPx>(given, point.pixel, point.inward, offset_px)) continue;
      const PixelAt moved(point.At(static_cast<float>(offset_px)));
      OutlinePoint on_mask;
      if (FitOutline(given, moved.u, moved.v, on_mask)) points_[kept++] = on_mask;
    }
    points_.truncate(kept);
  }

  Points points_;
  float std_px_ = 0.0F;
  float depth_std_px_ = 0.0F;
  OutlineSource source_ = OutlineSource::kDepth;
};

}  // namespace disflow
