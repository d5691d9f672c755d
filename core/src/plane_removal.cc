// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/plane_removal.h"

#include <algorithm>
#include <cmath>

namespace disflow {

template <class Take>
bool PlaneRemoval::Fit(Take&& take, Plane& plane) const noexcept {
  Vec3 mean = Vec3::Zero();
  int count = 0;
  for (const Point& p : points_) {
    if (!take(p)) continue;
    mean += Vec3(p.u, p.v, p.w);
    ++count;
  }
  if (count < kMinPerTile) return false;
  mean /= static_cast<float>(count);
  float uu = 0.0F, uv = 0.0F, vv = 0.0F, uw = 0.0F, vw = 0.0F;
  for (const Point& p : points_) {
    if (!take(p)) continue;
    const float u = p.u - mean.x();
    const float v = p.v - mean.y();
    uu += u * u;
    uv += u * v;
    vv += v * v;
    uw += u * (p.w - mean.z());
    vw += v * (p.w - mean.z());
  }
  const float determinant = uu * vv - uv * uv;
  if (!(determinant > 1e-3F * uu * vv) || !(uu > 0.0F)) return false;
  plane.slope_u = (vv * uw - uv * vw) / determinant;
  plane.slope_v = (uu * vw - uv * uw) / determinant;
  plane.offset = mean.z() - plane.slope_u * mean.x() - plane.slope_v * mean.y();
  return true;
}

bool PlaneRemoval::IsOn(const Plane& plane, const Point& p) noexcept {
  return std::abs(p.w - plane.At(p.u, p.v)) < kTolerance_per_m;
}

int PlaneRemoval::CountInliers(const Plane& plane) const noexcept {
  return static_cast<int>(std::count_if(points_.begin(), points_.end(),
                                        [&](const Point& p) { return IsOn(plane, p); }));
}

/// A face of the object ends within the box.
bool PlaneRemoval::ReachesBorder(const Plane& plane, const PixelBox& box) const noexcept {
  constexpr float kShare = 0.06F;
  const float du = kShare * static_cast<float>(box.width());
  const float dv = kShare * static_cast<float>(box.height());
  const auto inliers = std::count_if(points_.begin(), points_.end(), [&](const Point& p) {
    const bool at_border =
        p.u < static_cast<float>(box.u_min) + du || p.u >= static_cast<float>(box.u_max) - du ||
        p.v < static_cast<float>(box.v_min) + dv || p.v >= static_cast<float>(box.v_max) - dv;
    return at_border && IsOn(plane, p);
  });
  return inliers >= kMinAtBorder;
}

bool PlaneRemoval::FitTile(const PixelBox& box, int tile, Plane& plane) const noexcept {
  const float width = static_cast<float>(box.width()) / kTiles;
  const float height = static_cast<float>(box.height()) / kTiles;
  const int row = tile / kTiles;
  const float u_min =
      static_cast<float>(box.u_min) + width * static_cast<float>(tile - row * kTiles);
  const float v_min = static_cast<float>(box.v_min) + height * static_cast<float>(row);
  return Fit(
      [&](const Point& p) {
        return p.u >= u_min && p.u < u_min + width && p.v >= v_min && p.v < v_min + height;
      },
      plane);
}

float PlaneRemoval::NoiseNearby(const Plane& plane, const DepthReader& depth,
                                const PixelBox& box) const noexcept {
  constexpr int kApart_px = 4;                           // noise hangs together over one to three
  constexpr float kFar_per_m = 3.0F * kTolerance_per_m;  // what is farther off is something else
  const int step = StepOf(box);
  const auto for_each_pixel = [&](const auto& visit) {
    for (int v = box.v_min + step / 2; v < box.v_max; v += step) {
      for (int u = box.u_min + kApart_px; u < box.u_max - kApart_px; u += step)
        visit(u, v, plane.At(static_cast<float>(u), static_cast<float>(v)));
    }
  };
  const auto off = [&](int u, int v) {
    const float depth_m = depth.At(u, v);
    if (depth_m <= 0.0F) return 2.0F * kFar_per_m;
    return 1.0F / depth_m - plane.At(static_cast<float>(u), static_cast<float>(v));
  };
  float sum = 0.0F;
  float most = 0.0F;
  int count = 0;
  for_each_pixel([&](int u, int v, float w) {
    if (std::abs(off(u, v)) > kFar_per_m) return;
    sum += w;
    most = std::max(most, w);
    ++count;
  });
  if (count < kMinPoints) return 0.0F;
  const float near = 0.5F * (most + sum / static_cast<float>(count));
  sum = 0.0F;
  count = 0;
  for_each_pixel([&](int u, int v, float w) {
    if (w < near) return;
    const float left = off(u - kApart_px, v);
    const float here = off(u, v);
    const float right = off(u + kApart_px, v);
    if (std::max({std::abs(left), std::abs(here), std::abs(right)}) > kFar_per_m) return;
    sum += std::abs(left - 2.0F * here + right) / (w * w);
    ++count;
  });
  // Normal noise: sqrt(pi / 2) for the mean deviation, sqrt(6) for the difference.
  constexpr float kStdPerMeanDifference = 0.5117F;
  return count < kMinPoints ? 0.0F : kStdPerMeanDifference * sum / static_cast<float>(count);
}

void PlaneRemoval::FindPlanes(const PixelBox& box) noexcept {
  planes_.clear();
  const int total = points_.size();
  if (total < kMinPoints) return;
  while (!planes_.full()) {
    Plane best;
    int most = 0;
    for (int tile = 0; tile < kTiles * kTiles; ++tile) {
      Plane plane;
      if (!FitTile(box, tile, plane)) continue;
      const int inliers = CountInliers(plane);
      if (inliers <= most || !ReachesBorder(plane, box)) continue;
      most = inliers;
      best = plane;
    }
    if (most < kMinPoints || most < static_cast<int>(kMinShare * static_cast<float>(total))) return;
    for (int round = 0; round < 2; ++round) {
      (void)Fit([&](const Point& p) { return IsOn(best, p); }, best);
    }
    (void)planes_.push_back(best);
    for (int i = points_.size() - 1; i >= 0; --i)
      if (IsOn(best, points_[i])) points_.swap_remove(i);
  }
}

}  // namespace disflow
