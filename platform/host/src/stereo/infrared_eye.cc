// SPDX-License-Identifier: BSD-3-Clause
#include "infrared_eye.h"

#include <algorithm>
#include <cmath>

namespace disflow::host {
namespace {

/// Between the two eyes, as a D415's.
const Vec3d& ProjectorPlace_m() {
  static const Vec3d place_m(0.029, 0.0, 0.0);
  return place_m;
}

/// Disparity after which the grain is another one.
constexpr double kSpeckleLayer_px = 0.25;
constexpr float kBaseline_m = 0.055F;

void AddDot(double x, double y, double std_px, float brightness, int width, int height,
            std::vector<float>& image) {
  const int reach = static_cast<int>(std::ceil(3.5 * std_px));
  const int u0 = static_cast<int>(x);
  const int v0 = static_cast<int>(y);
  for (int v = std::max(0, v0 - reach); v <= std::min(height - 1, v0 + reach); ++v) {
    for (int u = std::max(0, u0 - reach); u <= std::min(width - 1, u0 + reach); ++u) {
      const double squared = (u - x) * (u - x) + (v - y) * (v - y);
      image[static_cast<std::size_t>(v * width + u)] +=
          brightness * static_cast<float>(std::exp(-0.5 * squared / (std_px * std_px)));
    }
  }
}

}  // namespace

DotPattern::DotPattern(double focal_px, int width_px, int height_px, std::uint64_t seed)
    : scale_(kOversampling * focal_px),
      // The projector reaches beyond the image on all sides, as it stands beside the eyes.
      width_(static_cast<int>(kOversampling * 1.8 * width_px)),
      height_(static_cast<int>(kOversampling * 1.4 * height_px)),
      image_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
  // At 640 px width; a dot is as large in the room whatever the camera's resolution.
  const double pixel = kOversampling * std::max(width_px / 640.0, 0.5);
  const double spacing = 4.5 * pixel;
  constexpr double kDotStd_px = 0.8;
  constexpr double kMissing = 0.25;
  constexpr std::uint64_t kStream = 12;
  RandomNumbers random(seed, kStream);
  for (double y = 0.0; y < height_; y += spacing) {
    for (double x = 0.0; x < width_; x += spacing) {
      const double dot_x = x + random.Uniform(0.0, spacing);
      const double dot_y = y + random.Uniform(0.0, spacing);
      const double brightness = random.Uniform(0.6, 1.2);
      if (random.Uniform() < kMissing) continue;
      AddDot(dot_x, dot_y, kDotStd_px * pixel, static_cast<float>(brightness), width_, height_,
             image_);
    }
  }
}

float DotPattern::At(const Vec3d& x_p_m) const {
  const double x = 0.5 * width_ + scale_ * x_p_m.x() / x_p_m.z();
  const double y = 0.5 * height_ + scale_ * x_p_m.y() / x_p_m.z();
  if (!(x >= 0.0 && y >= 0.0 && x < width_ - 1 && y < height_ - 1)) return 0.0F;
  const int u = static_cast<int>(x);
  const int v = static_cast<int>(y);
  const auto fx = static_cast<float>(x - u);
  const auto fy = static_cast<float>(y - v);
  const float* above = image_.data() + static_cast<std::ptrdiff_t>(v) * width_ + u;
  const float* below = above + width_;
  const float top = above[0] + fx * (above[1] - above[0]);
  const float bottom = below[0] + fx * (below[1] - below[0]);
  return top + fy * (bottom - top);
}

InfraredEye::InfraredEye(const EyeModel& model, std::uint64_t seed, int number)
    : model_(model),
      seed_(seed),
      number_(number),
      speckle_({.kernel_std_px = 0.5, .rest_correlation = 1.0, .layer_px = kSpeckleLayer_px},
               model.width_px, model.height_px, 2 * seed + static_cast<std::uint64_t>(number)),
      renderer_(model.camera, model.width_px, model.height_px),
      light_(renderer_.labels().size()),
      blurred_(light_.size()),
      image_(light_.size()) {}

void InfraredEye::Shade(const SceneView& scene, const SurfacePaint& paint, const DotPattern& dots) {
  const LightOfImage light(model_.camera, renderer_, scene.surfaces, paint, model_.eye_m);
  const Vec3d lamp = Vec3d(-0.3, -0.8, -0.5).normalized();  // above, on the left
  const std::span<const float> inverse_depth = renderer_.inverse_depth_per_m();
  std::size_t pixel = 0;
  for (int v = 0; v < model_.height_px; ++v) {
    for (int u = 0; u < model_.width_px; ++u, ++pixel) {
      const SurfaceLight seen = light.At(u, v);
      light_[pixel] = 0.0F;
      if (!(seen.albedo > 0.0)) continue;
      const Vec3d x_p_m = seen.position_m + model_.eye_m - ProjectorPlace_m();
      const double room = model_.ambient * (0.6 + 0.4 * std::max(0.0, seen.normal.dot(lamp)));
      constexpr double kBrightnessAt_m = 0.7;
      const double facing = std::max(0.0, -seen.normal.dot(x_p_m)) / x_p_m.norm();
      const double lit = model_.dots * facing * kBrightnessAt_m * kBrightnessAt_m /
                         x_p_m.squaredNorm() * static_cast<double>(dots.At(x_p_m));
      const float disparity_px = model_.camera.fx_px * kBaseline_m * inverse_depth[pixel];
      const double grain =
          1.0 + model_.speckle * static_cast<double>(speckle_.At(u, v, disparity_px));
      light_[pixel] = static_cast<float>(seen.albedo * (room + lit) * grain);
    }
  }
}

/// Both ways with five taps; the border of two pixels stays sharp.
void InfraredEye::Blur() {
  std::array<float, 3> taps{};
  double sum = 0.0;
  for (int k = -2; k <= 2; ++k)
    sum += std::exp(-0.5 * k * k / (model_.blur_std_px * model_.blur_std_px));
  for (int k = 0; k < 3; ++k) {
    taps[static_cast<std::size_t>(k)] = static_cast<float>(
        std::exp(-0.5 * k * k / (model_.blur_std_px * model_.blur_std_px)) / sum);
  }
  const auto blur = [&taps](const std::vector<float>& in, std::vector<float>& out,
                            std::size_t step) {
    out = in;
    for (std::size_t i = 2 * step; i + 2 * step < in.size(); ++i) {
      out[i] = taps[0] * in[i] + taps[1] * (in[i - step] + in[i + step]) +
               taps[2] * (in[i - 2 * step] + in[i + 2 * step]);
    }
  };
  blur(light_, blurred_, 1);
  blur(blurred_, light_, static_cast<std::size_t>(model_.width_px));
}

void InfraredEye::Expose(int frame, const SceneView& scene, const SurfacePaint& paint,
                         const DotPattern& dots) {
  scene.draw_from(model_.eye_m, renderer_);
  Shade(scene, paint, dots);
  Blur();
  constexpr std::uint64_t kFirstStream = 6'000'000;  // clear of all others
  RandomNumbers random(seed_, kFirstStream + 2 * static_cast<std::uint64_t>(frame) +
                                  static_cast<std::uint64_t>(number_));
  BitSource bits(random);
  const auto shot = static_cast<float>(model_.shot_noise);
  const auto read = static_cast<float>(model_.read_noise * model_.read_noise);
  for (std::size_t pixel = 0; pixel < image_.size(); ++pixel) {
    const float light = light_[pixel];
    const float level = light + std::sqrt(read + shot * light) * normal_.Draw(bits) + 0.5F;
    image_[pixel] = static_cast<std::uint8_t>(std::clamp(level, 0.0F, 255.0F));
  }
}

}  // namespace disflow::host
