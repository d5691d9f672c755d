// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/memory/fixed_vector.h"
#include "disflow/memory/median.h"
#include "disflow/types.h"

namespace disflow {

/// The outline of a mask near one of its pixels, as a straight line.
struct OutlinePoint {
  Vec2 pixel = Vec2::Zero();   ///< (u, v) of the pixel's centre.
  Vec2 inward = Vec2::Zero();  ///< Unit vector across the line.
  float distance_px = 0.0F;    ///< Of the pixel's centre from the line, inwards.

  /// So far inwards of the pixel.
  [[nodiscard]] Vec2 At(float inward_px) const noexcept { return pixel + inward_px * inward; }
  [[nodiscard]] Vec2 along() const noexcept { return {-inward.y(), inward.x()}; }
};

/// How far from an object's outline a sensor that matches windows of pixels still gives the
/// object's depth: half of a large window.
inline constexpr int kMatchingReachPx = 8;

/// Next to an outline, where pixels may be mixed ones.
inline constexpr int kFlyingPx = 2;

/// Half the width of the outline that a straight line is fitted to.
inline constexpr int kOutlineDiskPx = 4;

/// How far each row of that disk reaches to either side.
inline constexpr auto kOutlineDiskHalfWidths = [] {
  std::array<int, 2 * kOutlineDiskPx + 1> half_widths{};
  constexpr int kRadius = kOutlineDiskPx;
  for (int dv = -kRadius; dv <= kRadius; ++dv) {
    int half = 0;
    while ((half + 1) * (half + 1) + dv * dv <= kRadius * kRadius + kRadius) ++half;
    half_widths[static_cast<std::size_t>(dv + kRadius)] = half;
  }
  return half_widths;
}();
inline constexpr int kOutlineDiskPixels = [] {
  int pixels = 0;
  for (const int half : kOutlineDiskHalfWidths) pixels += 2 * half + 1;
  return pixels;
}();

/// Of any pixels of one of the disk's rows: how many they are, and the sum of their places in it.
struct OutlineRowSums {
  std::int8_t count;
  std::int8_t places;
};
inline constexpr auto kOutlineRowSums = [] {
  std::array<OutlineRowSums, 1U << (2 * kOutlineDiskPx + 1)> sums{};
  for (std::size_t bits = 0; bits < sums.size(); ++bits) {
    for (int place = 0; place <= 2 * kOutlineDiskPx; ++place) {
      const auto here = static_cast<std::int8_t>((bits >> static_cast<unsigned>(place)) & 1U);
      sums[bits].count = static_cast<std::int8_t>(sums[bits].count + here);
      sums[bits].places = static_cast<std::int8_t>(sums[bits].places + here * place);
    }
  }
  return sums;
}();

/// Fits a line to the mask's outline within a disk.
/// @param mask Has BitsIn(v, u_begin, count), as PixelMask.
/// @return false at corners and thin parts; `point` is undefined then.
template <class Mask>
[[nodiscard]] bool FitOutline(const Mask& mask, int u, int v, OutlinePoint& point) noexcept {
  constexpr int kRadius = kOutlineDiskPx;
  int sum_u = 0;
  int sum_v = 0;
  int inside = 0;
  for (int dv = -kRadius; dv <= kRadius; ++dv) {
    const int half = kOutlineDiskHalfWidths[static_cast<std::size_t>(dv + kRadius)];
    const OutlineRowSums& row =
        kOutlineRowSums[static_cast<std::size_t>(mask.BitsIn(v + dv, u - half, 2 * half + 1))];
    sum_u += row.places - half * row.count;
    inside += row.count;
    sum_v += dv * row.count;
  }
  const Vec2 sum(static_cast<float>(sum_u), static_cast<float>(sum_v));
  const float norm = sum.norm();
  constexpr auto area = static_cast<float>(kOutlineDiskPixels);
  const float radius = std::sqrt(area / 3.14159265F);
  // A half disk's centroid is 4 r / (3 pi) from the centre; at corners and thin parts it is nearer.
  const float half_moment = 0.5F * area * 0.4244F * radius;
  const float share = static_cast<float>(inside) / area;
  if (norm < 0.85F * half_moment || share < 0.35F || share > 0.72F) return false;
  point.pixel = Vec2(static_cast<float>(u), static_cast<float>(v));
  point.inward = sum / norm;
  // To first order the covered area grows by the disk's diameter per pixel of distance.
  point.distance_px = (share - 0.5F) * area / (2.0F * radius);
  return true;
}

/// Where a mask begins, from outside inwards.
/// @tparam kReachPx How far from the place it is looked for, to either side.
/// @param place In the image or near it.
/// @param offset_px Of the first pixel inside, inwards of `place`.
/// @return false if it does not begin within reach.
template <int kReachPx, class Mask>
[[nodiscard]] bool FindOutline(const Mask& mask, const Vec2& place, const Vec2& inward,
                               int& offset_px) noexcept {
  constexpr int kSteps = 2 * kReachPx + 1;
  constexpr int kGroup = 4;
  // In whole groups, for vector instructions: all pixels first, though half of them are not needed.
  constexpr auto kCount = static_cast<std::size_t>((kSteps + kGroup - 1) / kGroup * kGroup);
  std::array<int, kCount> u;
  std::array<int, kCount> v;
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto step = static_cast<float>(static_cast<int>(i) - kReachPx);
    u[i] = PixelAt::NearestInReach(place.x() + step * inward.x());
    v[i] = PixelAt::NearestInReach(place.y() + step * inward.y());
  }
  std::size_t i = 0;
  while (i < static_cast<std::size_t>(kSteps) && !mask.Test(u[i], v[i])) ++i;
  offset_px = static_cast<int>(i) - kReachPx;
  return i > 0 && i < static_cast<std::size_t>(kSteps);
}

/// How ragged a mask's outline is, at the scale at which lines are fitted to it: from third
/// differences of its place along itself, which straight and evenly bent outlines do not have.
template <int kMaxPoints>
class OutlineNoise {
 public:
  template <class Mask>
  void Add(const Mask& mask, const OutlinePoint& point) noexcept {
    constexpr float kSpacing_px = 2.0F * kOutlineDiskPx + 1.0F;
    std::array<float, 4> offset_px;
    for (std::size_t i = 0; i < offset_px.size(); ++i) {
      const float at_px = (static_cast<float>(i) - 1.5F) * kSpacing_px;
      const Vec2 place = point.pixel + at_px * point.along();
      if (!MeanOffset(mask, place, point, offset_px[i])) return;
    }
    (void)contrasts_px_.push_back(
        std::abs(offset_px[3] - offset_px[0] + 3.0F * (offset_px[1] - offset_px[2])));
  }

  /// @return Standard deviation; 0 if nothing is known.
  [[nodiscard]] float std_px() noexcept {
    constexpr float kStdOfContrast = 4.4721F;  // sqrt(1 + 9 + 9 + 1)
    return MedianOf(contrasts_px_.begin(), contrasts_px_.end()) /
           (kStdOfContrast * kMedianPerSigma);
  }

 private:
  /// Mean of three places within a disk's width.
  template <class Mask>
  [[nodiscard]] static bool MeanOffset(const Mask& mask, const Vec2& place,
                                       const OutlinePoint& point, float& offset_px) noexcept {
    constexpr int kReachPx = 6;
    constexpr float kThird_px = 3.0F;
    offset_px = 0.0F;
    for (int i = -1; i <= 1; ++i) {
      int one_px = 0;
      const Vec2 start = place + kThird_px * static_cast<float>(i) * point.along();
      if (!FindOutline<kReachPx>(mask, start, point.inward, one_px)) return false;
      offset_px += static_cast<float>(one_px) / 3.0F;
    }
    return true;
  }

  FixedVector<float, kMaxPoints> contrasts_px_;
};

}  // namespace disflow
