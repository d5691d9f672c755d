// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/depth/depth_reader.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/memory/fixed_vector.h"
#include "disflow/types.h"

namespace disflow {

/// Finds the planes that an object stands on or leans against: those that go on beyond the part of
/// the image where the object can be. A face of the object ends within it and stays.
///
/// In inverse depth w = 1/z a plane is affine in the pixel, w = a u + b v + c, and the noise of a
/// stereo sensor is the same everywhere, so one tolerance does for near and far. A time-of-flight
/// camera's is the same in depth: where a plane is near, its own noise there counts if that is
/// more.
class PlaneRemoval {
 public:
  /// @param box Part of the image to look at.
  /// @param is_context is_context(u, v, depth_m): whether a pixel of the box surely is not the
  /// object.
  template <class IsContext>
  void Find(const DepthReader& depth, const PixelBox& box, IsContext&& is_context) noexcept {
    Collect(depth, box, is_context);
    FindPlanes(box);
    for (Plane& plane : planes_) plane.noise_m = NoiseNearby(plane, depth, box);
  }

  void Clear() noexcept { planes_.clear(); }
  [[nodiscard]] bool empty() const noexcept { return planes_.empty(); }

  /// Sets to 0 the depths of a row's pixels that lie on a plane.
  void operator()(int v, int u_begin, int u_end, float* depth_m) const noexcept {
    for (const Plane& plane : planes_) {
      const float start = plane.At(static_cast<float>(u_begin), static_cast<float>(v));
      const float nearby_m = kNearbyStds * plane.noise_m;
      for (int i = 0; i < u_end - u_begin; ++i) {
        const float z = depth_m[i];
        const float w = start + plane.slope_u * static_cast<float>(i);
        const float tolerance = std::max(kTolerance_per_m * z, nearby_m * w);
        depth_m[i] = std::abs(1.0F - z * w) < tolerance ? 0.0F : z;
      }
    }
  }

 private:
  struct Plane {
    float slope_u = 0.0F;
    float slope_v = 0.0F;
    float offset = 0.0F;
    float noise_m = 0.0F;  ///< Standard deviation of depth on its nearer half.
    [[nodiscard]] float At(float u, float v) const noexcept {
      return slope_u * u + slope_v * v + offset;
    }
  };
  struct Point {
    float u, v, w;
  };
  static constexpr int kMaxPlanes = 3;
  static constexpr int kMaxPoints = 640;
  static constexpr int kTiles = 6;  ///< Planes are guessed from the tiles of a 6 x 6 grid.
  static constexpr int kMinPoints = 24;
  static constexpr int kMinPerTile = 5;
  static constexpr int kMinAtBorder = 8;
  static constexpr float kMinShare = 0.2F;
  /// Three standard deviations of a good stereo camera's inverse depth.
  static constexpr float kTolerance_per_m = 0.010F;
  /// Of 100,000 pixels of a table three standard deviations leave 300, four 6.
  static constexpr float kNearbyStds = 4.0F;

  [[nodiscard]] static int StepOf(const PixelBox& box) noexcept {
    const auto area = static_cast<float>(box.width()) * static_cast<float>(box.height());
    return std::max(2,
                    static_cast<int>(std::ceil(std::sqrt(area / static_cast<float>(kMaxPoints)))));
  }

  template <class IsContext>
  void Collect(const DepthReader& depth, const PixelBox& box, IsContext& is_context) noexcept {
    points_.clear();
    const int step = StepOf(box);
    for (int v = box.v_min + step / 2; v < box.v_max; v += step) {
      for (int u = box.u_min + step / 2; u < box.u_max; u += step) {
        const float depth_m = depth.At(u, v);
        if (depth_m > 0.0F && is_context(u, v, depth_m))
          (void)points_.push_back({static_cast<float>(u), static_cast<float>(v), 1.0F / depth_m});
      }
    }
  }

  /// Of what is nearer than the plane is in the mean, by second differences in a row, which an
  /// uneven ground does not have.
  [[nodiscard]] float NoiseNearby(const Plane& plane, const DepthReader& depth,
                                  const PixelBox& box) const noexcept;

  void FindPlanes(const PixelBox& box) noexcept;
  [[nodiscard]] static bool IsOn(const Plane& plane, const Point& p) noexcept;
  [[nodiscard]] int CountInliers(const Plane& plane) const noexcept;
  [[nodiscard]] bool ReachesBorder(const Plane& plane, const PixelBox& box) const noexcept;
  [[nodiscard]] bool FitTile(const PixelBox& box, int tile, Plane& plane) const noexcept;
  /// Least squares over the points that `take` accepts.
  template <class Take>
  [[nodiscard]] bool Fit(Take&& take, Plane& plane) const noexcept;

  FixedVector<Point, kMaxPoints + kMaxPoints / 4> points_;
  FixedVector<Plane, kMaxPlanes> planes_;
};

}  // namespace disflow
