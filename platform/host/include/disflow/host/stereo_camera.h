// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "disflow/host/depth_camera.h"

namespace disflow::host {

class DotPattern;
class InfraredEye;
class SurfacePaint;

/// Whether this program finds OpenCV's matcher, without which there is no StereoCamera.
[[nodiscard]] bool StereoIsAvailable();

/// Active stereo: two infrared images, 55 mm apart, of painted surfaces under a pattern of dots
/// that is fixed to the camera, matched by OpenCV's semi-global matcher. With NoiseKind::kStereo
/// its disparities are refined, with kStereoRaw a badly tuned matcher's are taken as they come.
class StereoCamera final : public DepthCamera {
 public:
  /// @throws std::runtime_error unless StereoIsAvailable().
  explicit StereoCamera(const SimulationOptions& options);
  ~StereoCamera() override;
  void Measure(int frame, const SceneView& scene, std::span<float> depth_m) override;
  [[nodiscard]] std::span<const std::uint8_t> infrared() const override { return infrared_; }

  static constexpr double kBaseline_m = 0.055;
  static constexpr double kNearest_m = 0.29;

 private:
  void Match();
  void Refine();

  SimulationOptions options_;
  PinholeCamera camera_;
  /// Both images go on to the left by this, or nothing could be matched there.
  int margin_px_;
  std::unique_ptr<SurfacePaint> paint_;
  std::unique_ptr<DotPattern> dots_;
  std::unique_ptr<InfraredEye> left_;
  std::unique_ptr<InfraredEye> right_;
  std::vector<std::int16_t> disparity_16ths_;
  std::vector<float> disparity_px_;
  std::vector<float> left_levels_;
  std::vector<float> right_levels_;
  std::vector<std::uint8_t> infrared_;
};

}  // namespace disflow::host
