// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/config.h"
#include "disflow/depth/contour_bend.h"
#include "disflow/depth/object_outline.h"
#include "disflow/depth/outline_scale.h"
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
  /// @param given The user's mask, if there is one.
  /// @param least_std_px Noise of the best outline.
  /// @param scale What is known of outlines beyond how ragged they are.
  template <class Mask>
  [[nodiscard]] static SampledOutline Sample(const DepthReader& depth, const PinholeCamera& camera,
                                             const Mask& object, const MaskView& given,
                                             const SurfaceSampler<Limits>& surfaces,
                                             const SamplerConfig& config, float least_std_px,
                                             const OutlineScale& scale, Edges& edges) noexcept {
    edges.clear();
    Outline outline;
    outline.Find(object, given);
    const float std_px = scale.Of(outline.source()) * std::fmax(outline.std_px(), least_std_px);
    for (const OutlinePoint& point : outline.points()) {
      EdgePoint edge;
      if (MakeEdge(depth, camera, outline, point, surfaces, config, std_px, edge))
        (void)edges.push_back(edge);
    }
    return {outline.source(), std_px};
  }

 private:
  using Outline = ObjectOutline<Limits::kMaxEdgePoints>;

  static constexpr int kProbePx = 6;
  static constexpr int kShadowPx = 64;
  static constexpr int kBackgroundPixels = 3;
  // Between the normals beside the outline and farther in, rad. On round things the outline is no
  // edge; on noisy images few windows of a flat face agree by one standard deviation, nearly all by
  // three.
  static constexpr float kFlatTilt = 0.08F;
  static constexpr float kMostSteadyTilt = 0.3F;
  static constexpr float kMostTilt = 0.5F;

  [[nodiscard]] static bool MakeEdge(const DepthReader& depth, const PinholeCamera& camera,
                                     const Outline& outline, const OutlinePoint& point,
                                     const SurfaceSampler<Limits>& surfaces,
                                     const SamplerConfig& config, float std_px,
                                     EdgePoint& edge) noexcept {
    const auto surface_at = [&](float inward_px) {
      const PixelAt p(point.At(inward_px));
      return surfaces.SurfaceAt(p.u, p.v);
    };
    const auto step = static_cast<float>(std::max(surfaces.block_px(), 2));
    const float first_px = static_cast<float>(config.border_px) + 0.75F * step;
    float near_px = first_px;
    auto near = surface_at(near_px);
    if (!near.valid) {
      near_px += step;
      near = surface_at(near_px);
    }
    const auto inner = surface_at(first_px + 2.0F * step);
    if (!near.valid || !inner.valid || near.cos_incidence < config.edge_min_cos_incidence)
      return false;
    const float tilt = (near.normal - inner.normal).norm();
    const float tilt_std = std::sqrt(near.normal_variance + inner.normal_variance);
    if (tilt > std::min(kMostTilt, kFlatTilt + 3.0F * tilt_std)) return false;
    edge.steady = tilt <= std::min(kMostSteadyTilt, kFlatTilt + tilt_std);

    const Vec2 place = point.At(-point.distance_px);
    const Vec3 ray = camera.Ray(place.x(), place.y());
    const float facing = near.normal.dot(ray);
    const float depth_m = near.offset_m / facing;
    // Beside an exact mask the depth goes on as far as windows are matched.
    const int rim_px = outline.source() == OutlineSource::kMask ? kMatchingReachPx : kFlyingPx;
    if (!(depth_m > 0.0F) || !EndsBeforeBackground(depth, config, point, rim_px, depth_m))
      return false;
    // Where the depth's outline is ragged, its last pixels say nothing.
    const int ragged_px = static_cast<int>(std::lround(2.0F * outline.depth_std_px()));
    if (!ReachesOutline(depth, camera, point, ragged_px, near, surfaces.noise_std())) return false;

    const Vec3 along = camera.Ray(place.x() + point.along().x(), place.y() + point.along().y());
    const Vec3 inside = camera.Ray(place.x() + point.inward.x(), place.y() + point.inward.y());
    edge.position_m = depth_m * ray;
    edge.normal = near.normal;
    edge.ray = ray.normalized();
    // The edge lies in the surface and in the plane through the camera and the outline's tangent.
    edge.direction = near.normal.cross(ray.cross(along)).normalized();
    edge.outward = edge.ray.cross(edge.direction).normalized();
    if (edge.outward.dot(inside) > 0.0F) edge.outward = -edge.outward;
    const float pixel_m = depth_m / camera.fx_px;
    edge.variance_m2 = pixel_m * pixel_m * (std_px * std_px);
    // The plane is known at its block, and tilts from there to the outline.
    const float along_normal_m2 =
        near.variance_m2 + near.normal_variance * (edge.position_m - near.position_m).squaredNorm();
    edge.depth_variance_m2 = along_normal_m2 * ray.squaredNorm() / (facing * facing);
    edge.bend_m = ContourBend({near.cos_incidence, inner.cos_incidence,
                               pixel_m * (near_px + point.distance_px),
                               pixel_m * (first_px + 2.0F * step + point.distance_px),
                               near.normal_variance + inner.normal_variance});
    return edge.direction.allFinite();
  }

  /// The pixels up to the outline lie on the surface: no sliver of another face, seen at a flat
  /// angle, is in between. Judged, row by row along the outline, by the deviation that a third of
  /// the pixels keep below: noise and flying pixels disturb it less than single pixels.
  [[nodiscard]] static bool ReachesOutline(const DepthReader& depth, const PinholeCamera& camera,
                                           const OutlinePoint& point, int first_px,
                                           const BlockPlane& surface, float noise_std) noexcept {
    constexpr int kRows = 4;
    constexpr int kHalfLength = 3;
    constexpr float kPlaneTolerance = 0.001F;  // share of the depth
    const float tolerance = 0.9F * noise_std + kPlaneTolerance / std::abs(surface.offset_m);
    int agreeing = 0;
    for (int row = 0; row < kRows; ++row) {
      FixedVector<float, 2 * kHalfLength + 1> deviations;
      for (int i = -kHalfLength; i <= kHalfLength; ++i) {
        const PixelAt p(Vec2(point.At(static_cast<float>(first_px + row)) +
                             static_cast<float>(i) * point.along()));
        const float depth_m = depth.AtOrZero(p.u, p.v);
        if (depth_m <= 0.0F) continue;
        const Vec3 ray = camera.Ray(static_cast<float>(p.u), static_cast<float>(p.v));
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
  /// @param rim_px Pixels next to the outline that may show the object.
  [[nodiscard]] static bool EndsBeforeBackground(const DepthReader& depth,
                                                 const SamplerConfig& config,
                                                 const OutlinePoint& point, int rim_px,
                                                 float depth_m) noexcept {
    const float gap_m = config.edge_background_gap_m;
    int background = 0;
    for (int i = kFlyingPx; i <= kShadowPx && background < kBackgroundPixels;
         i += i < kProbePx || background > 0 ? 1 : 2) {
      const PixelAt p(point.At(-static_cast<float>(i)));
      const float outside_m = depth.AtOrZero(p.u, p.v);
      if (outside_m <= 0.0F) continue;
      if (outside_m > depth_m + gap_m) {
        ++background;
      } else if (i > rim_px || (i > kFlyingPx && outside_m < depth_m - gap_m)) {
        return false;
      }
    }
    return background > 0;
  }
};

}  // namespace disflow
