// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "disflow/geometry/pinhole_camera.h"
#include "disflow/host/depth_camera.h"

namespace disflow::host {

/// What a pixel's surface does with light.
struct SurfaceLight {
  Vec3d position_m = Vec3d::Zero();  ///< Camera frame.
  Vec3d normal = Vec3d::Zero();      ///< Towards the camera.
  double cos_incidence = 0.0;        ///< Of the ray from the camera.
  double albedo = 0.0;               ///< 0 where nothing is seen.
};

/// The paint of all surfaces: noise of three grain sizes in the surface's own three dimensions, so
/// that it moves and turns with it and looks the same from both eyes.
class SurfacePaint {
 public:
  explicit SurfacePaint(std::uint64_t seed);
  /// @return 0.1 to 0.95.
  [[nodiscard]] float AlbedoAt(std::uint32_t label, const Vec3d& x_s_m) const;

 private:
  [[nodiscard]] float Grain(float x, float y, float z) const;
  std::vector<float> lattice_;
};

/// Light of one image, pixel by pixel.
class LightOfImage {
 public:
  /// @param eye_m Where the image was taken, in the frame of the surfaces' T_sc.
  LightOfImage(const PinholeCamera& camera, const DepthRenderer& image,
               std::span<const PaintedSurface> surfaces, const SurfacePaint& paint,
               const Vec3d& eye_m);
  [[nodiscard]] SurfaceLight At(int u, int v) const;

 private:
  [[nodiscard]] double Slope(std::size_t pixel, int at, int count, std::size_t step) const;
  const PaintedSurface* SurfaceOf(std::uint32_t label) const;

  PinholeCamera camera_;
  const DepthRenderer& image_;
  std::span<const PaintedSurface> surfaces_;
  const SurfacePaint& paint_;
  Vec3d eye_m_;
};

}  // namespace disflow::host
