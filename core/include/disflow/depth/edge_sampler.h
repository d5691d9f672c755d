// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/config.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/depth/surface_sampler.h"

namespace disflow {

/// Finds occluding edges: places on the object's outline where a well-fitted, steady surface ends
/// in front of something farther away. When only one or two flat faces are visible the object could
/// slide along them unseen; these points see it.
template <class Limits>
class EdgeSampler {
 public:
  using Edges = FixedVector<EdgePoint, Limits::kMaxEdgePoints>;

  /// @param object All of the object's pixels, not eroded.
  template <class Mask>
  static void Sample(const DepthReader& depth, const PinholeCamera& camera, const Mask& object,
                     const SurfaceSampler<Limits>& surfaces, const SamplerConfig& config,
                     Edges& edges) noexcept {
    edges.clear();
    // Two passes: count the outline, then take every k-th of its points, so that the whole outline
    // is represented.
    int outline = 0;
    ForEachOutlinePixel(object, [&outline](int, int) { ++outline; });
    // Steps of the golden ratio: a regular stride would, row by row, meet the left outline alone.
    constexpr float kGoldenRatio = 0.61803399F;
    const float share = static_cast<float>(Limits::kMaxEdgePoints) /
                        static_cast<float>(std::max(outline, Limits::kMaxEdgePoints));
    float phase = 0.0F;
    ForEachOutlinePixel(object, [&](int u, int v) {
      phase += kGoldenRatio;
      phase -= std::floor(phase);
      if (phase >= share) return;
      EdgePoint edge;
      if (MakeEdge(depth, camera, object, surfaces, config, u, v, edge))
        (void)edges.push_back(edge);
    });
  }

 private:
  static constexpr int kDiskRadiusPx = 4;
  static constexpr int kProbePx = 6;
  static constexpr int kShadowPx = 64;
  static constexpr int kBackgroundPixels = 3;

  template <class Mask, class Visitor>
  static void ForEachOutlinePixel(const Mask& object, Visitor&& visit) noexcept {
    for (int v = object.box().v_min; v < object.box().v_max; ++v)
      object.ForEachOutlineInRow(v, [&](int u) { visit(u, v); });
  }

  /// The outline near a pixel as a straight line: inward normal, and signed distance of the pixel's
  /// centre from it.
  struct OutlineFit {
    bool straight = false;
    Vec2 inward = Vec2::Zero();
    float distance_px = 0.0F;
  };
  template <class Mask>
  [[nodiscard]] static OutlineFit FitOutline(const Mask& object, int u, int v) noexcept {
    OutlineFit fit;
    Vec2 sum = Vec2::Zero();
    int inside = 0;
    int total = 0;
    for (int dv = -kDiskRadiusPx; dv <= kDiskRadiusPx; ++dv) {
      for (int du = -kDiskRadiusPx; du <= kDiskRadiusPx; ++du) {
        if (du * du + dv * dv > kDiskRadiusPx * kDiskRadiusPx + kDiskRadiusPx) continue;
        ++total;
        if (!object.Test(u + du, v + dv)) continue;
        ++inside;
        sum += Vec2(static_cast<float>(du), static_cast<float>(dv));
      }
    }
    const float norm = sum.norm();
    const auto area = static_cast<float>(total);
    const float radius = std::sqrt(area / 3.14159265F);
    // A half disk's centroid is 4 r / (3 pi) from the centre; at corners and thin parts it is
    // nearer.
    const float half_moment = 0.5F * area * 0.4244F * radius;
    const float share = static_cast<float>(inside) / area;
    if (norm < 0.85F * half_moment || share < 0.35F || share > 0.72F) return fit;
    fit.straight = true;
    fit.inward = sum / norm;
    // To first order the covered area grows by the disk's diameter per pixel of distance.
    fit.distance_px = (share - 0.5F) * area / (2.0F * radius);
    return fit;
  }

  template <class Mask>
  [[nodiscard]] static bool MakeEdge(const DepthReader& depth, const PinholeCamera& camera,
                                     const Mask& object, const SurfaceSampler<Limits>& surfaces,
                                     const SamplerConfig& config, int u, int v,
                                     EdgePoint& edge) noexcept {
    const OutlineFit fit = FitOutline(object, u, v);
    if (!fit.straight) return false;
    const auto at = [&](float inward_px) {
      return Vec2(static_cast<float>(u) + inward_px * fit.inward.x(),
                  static_cast<float>(v) + inward_px * fit.inward.y());
    };
    const auto surface_at = [&](float inward_px) {
      const Vec2 p = at(inward_px);
      return surfaces.SurfaceAt(static_cast<int>(std::lround(p.x())),
                                static_cast<int>(std::lround(p.y())));
    };
    const auto step = static_cast<float>(std::max(surfaces.block_px(), 2));
    const float first_px = static_cast<float>(config.border_px) + 0.75F * step;
    auto near = surface_at(first_px);
    if (!near.valid) near = surface_at(first_px + step);
    const auto inner = surface_at(first_px + 2.0F * step);
    if (!near.valid || !inner.valid || near.cos_incidence < config.edge_min_cos_incidence)
      return false;
    const float tilt_variance = near.normal_variance + inner.normal_variance;
    const float allowed_tilt = std::min(0.3F, 0.08F + 2.0F * std::sqrt(tilt_variance));
    if ((near.normal - inner.normal).norm() > allowed_tilt) return false;

    const Vec2 outline = at(-fit.distance_px);
    const Vec3 ray = camera.Ray(outline.x(), outline.y());
    const float facing = near.normal.dot(ray);
    const float depth_m = near.offset_m / facing;
    if (!(depth_m > 0.0F) || !EndsBeforeBackground(depth, config, at, depth_m)) return false;
    if (!ReachesOutline(depth, camera, at, fit.inward, near, surfaces.noise_std())) return false;

    const Vec3 along = camera.Ray(outline.x() - fit.inward.y(), outline.y() + fit.inward.x());
    edge.position_m = depth_m * ray;
    edge.normal = near.normal;
    edge.ray = ray.normalized();
    // The edge lies in the surface and in the plane through the camera and the outline's tangent.
    edge.direction = near.normal.cross(ray.cross(along)).normalized();
    edge.pixel_m = depth_m / camera.fx_px;
    return edge.direction.allFinite();
  }

  /// The pixels up to the outline lie on the surface: no sliver of another face, seen at a flat
  /// angle, is in between. Judged, row by row along the outline, by the deviation that a third of
  /// the pixels keep below: noise and flying pixels disturb it less than single pixels.
  template <class At>
  [[nodiscard]] static bool ReachesOutline(const DepthReader& depth, const PinholeCamera& camera,
                                           const At& at, const Vec2& inward,
                                           const BlockPlane& surface, float noise_std) noexcept {
    constexpr int kRows = 4;
    constexpr int kHalfLength = 3;
    constexpr float kPlaneTolerance = 0.001F;  // share of the depth
    const float tolerance = 0.9F * noise_std + kPlaneTolerance / std::abs(surface.offset_m);
    const Vec2 along(-inward.y(), inward.x());
    int agreeing = 0;
    for (int row = 0; row < kRows; ++row) {
      FixedVector<float, 2 * kHalfLength + 1> deviations;
      for (int i = -kHalfLength; i <= kHalfLength; ++i) {
        const Vec2 p = at(static_cast<float>(row)) + static_cast<float>(i) * along;
        const auto u = static_cast<int>(std::lround(p.x()));
        const auto v = static_cast<int>(std::lround(p.y()));
        const float depth_m = depth.AtOrZero(u, v);
        if (depth_m <= 0.0F) continue;
        const Vec3 ray = camera.Ray(static_cast<float>(u), static_cast<float>(v));
        (void)deviations.push_back(
            std::abs(1.0F / depth_m - surface.normal.dot(ray) / surface.offset_m));
      }
      if (deviations.size() < kHalfLength) continue;
      auto* middle = deviations.begin() + deviations.size() / 3;
      std::nth_element(deviations.begin(), middle, deviations.end());
      if (*middle > tolerance) return false;
      ++agreeing;
    }
    return agreeing >= 2;
  }

  /// What is seen outside of the outline is farther away. Next to it there may be nothing: a stereo
  /// sensor has no depth where its second view is occluded by the object itself.
  template <class At>
  [[nodiscard]] static bool EndsBeforeBackground(const DepthReader& depth,
                                                 const SamplerConfig& config, const At& at,
                                                 float depth_m) noexcept {
    int background = 0;
    for (int i = 2; i <= kShadowPx && background < kBackgroundPixels;
         i += i < kProbePx || background > 0 ? 1 : 2) {
      const Vec2 p = at(-static_cast<float>(i));
      const float outside_m = depth.AtOrZero(static_cast<int>(std::lround(p.x())),
                                             static_cast<int>(std::lround(p.y())));
      if (outside_m <= 0.0F) continue;
      if (outside_m > depth_m + config.edge_background_gap_m) {
        ++background;
      } else if (i > 2) {
        return false;  // the first pixel may be a flying one
      }
    }
    return background > 0;
  }
};

}  // namespace disflow
