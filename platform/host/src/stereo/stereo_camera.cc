// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/stereo_camera.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "infrared_eye.h"
#include "semi_global_matcher.h"
#include "subpixel_refinement.h"

namespace disflow::host {
namespace {

constexpr int kBlockOfDisparities = 16;  // the matcher takes multiples of it

int LargestDisparity(const PinholeCamera& camera) {
  const double nearest_px =
      static_cast<double>(camera.fx_px) * StereoCamera::kBaseline_m / StereoCamera::kNearest_m;
  return kBlockOfDisparities * static_cast<int>(std::ceil(nearest_px / kBlockOfDisparities));
}

SemiGlobalSettings MatcherOf(NoiseKind noise, int disparities) {
  SemiGlobalSettings settings;
  settings.num_disparities = disparities;
  settings.block_size = 3;
  settings.p1 = 40;
  settings.p2 = 600;
  settings.uniqueness_ratio = 0;
  settings.disp12_max_diff = 2;
  if (noise == NoiseKind::kStereoRaw) {
    settings.disp12_max_diff = 1;
    settings.speckle_window_size = 0;
  }
  return settings;
}

EyeModel ModelOf(const PinholeCamera& camera, const SimulationOptions& options, int margin_px,
                 const Vec3d& eye_m) {
  EyeModel model;
  model.camera = camera;
  model.camera.cx_px += static_cast<float>(margin_px);
  model.width_px = options.width_px + margin_px;
  model.height_px = options.height_px;
  model.eye_m = eye_m;
  return model;
}

}  // namespace

bool StereoIsAvailable() { return FindSemiGlobalMatcher() != nullptr; }

StereoCamera::StereoCamera(const SimulationOptions& options)
    : options_(options),
      camera_(SimulatedCamera(options)),
      margin_px_(LargestDisparity(camera_)),
      paint_(std::make_unique<SurfacePaint>(options.seed)),
      dots_(std::make_unique<DotPattern>(static_cast<double>(camera_.fx_px), options.width_px,
                                         options.height_px, options.seed)),
      left_(std::make_unique<InfraredEye>(ModelOf(camera_, options, margin_px_, Vec3d::Zero()),
                                          options.seed, 0)),
      right_(std::make_unique<InfraredEye>(
          ModelOf(camera_, options, margin_px_, Vec3d(kBaseline_m, 0.0, 0.0)), options.seed, 1)),
      disparity_16ths_(left_->image().size()),
      disparity_px_(left_->image().size()),
      infrared_(static_cast<std::size_t>(options.width_px) *
                static_cast<std::size_t>(options.height_px)) {
  if (!StereoIsAvailable()) throw std::runtime_error("the stereo camera was built without OpenCV");
}

StereoCamera::~StereoCamera() = default;

void StereoCamera::Match() {
  const SemiGlobalSettings settings = MatcherOf(options_.noise, margin_px_);
  FindSemiGlobalMatcher()(&settings, left_->image().data(), right_->image().data(),
                          left_->model().width_px, left_->model().height_px,
                          disparity_16ths_.data());
  std::transform(disparity_16ths_.begin(), disparity_16ths_.end(), disparity_px_.begin(),
                 [](std::int16_t steps) {
                   // Nothing was found, or something at infinity.
                   return steps <= 0 ? -1.0F : static_cast<float>(steps) / float{kDisparitySteps};
                 });
}

void StereoCamera::Refine() {
  left_levels_.assign(left_->image().begin(), left_->image().end());
  right_levels_.assign(right_->image().begin(), right_->image().end());
  RefineDisparities(
      {left_levels_, right_levels_, left_->model().width_px, left_->model().height_px},
      disparity_px_);
  constexpr float kSteps = 32.0F;
  for (float& disparity_px : disparity_px_) {
    if (disparity_px > 0.0F) disparity_px = std::round(kSteps * disparity_px) / kSteps;
  }
}

void StereoCamera::Measure(int frame, const SceneView& scene, std::span<float> depth_m) {
  left_->Expose(frame, scene, *paint_, *dots_);
  right_->Expose(frame, scene, *paint_, *dots_);
  Match();
  if (options_.noise == NoiseKind::kStereo) Refine();
  const auto focal_baseline = static_cast<float>(static_cast<double>(camera_.fx_px) * kBaseline_m);
  const auto width = static_cast<std::size_t>(options_.width_px);
  const auto margin = static_cast<std::size_t>(margin_px_);
  for (std::size_t v = 0; v < static_cast<std::size_t>(options_.height_px); ++v) {
    for (std::size_t u = 0; u < width; ++u) {
      const std::size_t from = v * (width + margin) + margin + u;
      const float disparity_px = disparity_px_[from];
      depth_m[v * width + u] = disparity_px > 0.0F ? focal_baseline / disparity_px : 0.0F;
      infrared_[v * width + u] = left_->image()[from];
    }
  }
}

}  // namespace disflow::host
