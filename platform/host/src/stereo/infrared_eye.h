// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "disflow/host/depth_camera.h"
#include "disflow/host/image_noise.h"
#include "surface_light.h"

namespace disflow::host {

/// Dots as a projector throws them, one about every `spacing` with gaps and random places, in
/// directions from the projector.
class DotPattern {
 public:
  /// @param focal_px Pixels per unit of x/z.
  DotPattern(double focal_px, int width_px, int height_px, std::uint64_t seed);
  /// Brightness of a place in the projector's frame; a dot's middle is about 1.
  [[nodiscard]] float At(const Vec3d& x_p_m) const;

 private:
  static constexpr double kOversampling = 2.0;
  double scale_;
  int width_;
  int height_;
  std::vector<float> image_;
};

struct EyeModel {
  PinholeCamera camera;
  int width_px = 0;
  int height_px = 0;
  Vec3d eye_m = Vec3d::Zero();  ///< In the left camera's frame.
  double blur_std_px = 0.6;
  double ambient = 70.0;      ///< Grey levels of a white surface, lit by the room.
  double dots = 75.0;         ///< Of a dot's middle on a white surface, facing at 0.7 m.
  double shot_noise = 0.013;  ///< Variance per grey level.
  double read_noise = 0.6;    ///< Grey levels.
  /// Share of the light. The laser's grain differs between the eyes and stays while nothing moves.
  double speckle = 0.05;
};

/// One infrared camera of a stereo pair.
class InfraredEye {
 public:
  /// @param number Tells the noise of the two eyes apart.
  InfraredEye(const EyeModel& model, std::uint64_t seed, int number);
  /// Takes an image of the scene.
  void Expose(int frame, const SceneView& scene, const SurfacePaint& paint, const DotPattern& dots);

  [[nodiscard]] const std::vector<std::uint8_t>& image() const { return image_; }
  [[nodiscard]] const EyeModel& model() const { return model_; }

 private:
  void Shade(const SceneView& scene, const SurfacePaint& paint, const DotPattern& dots);
  void Blur();

  EyeModel model_;
  std::uint64_t seed_;
  int number_;
  NormalTable normal_;
  ImageNoise speckle_;
  DepthRenderer renderer_;
  std::vector<float> light_;
  std::vector<float> blurred_;
  std::vector<std::uint8_t> image_;
};

}  // namespace disflow::host
