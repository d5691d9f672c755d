// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/depth_camera.h"

#include <algorithm>

#include "disflow/host/sensor_noise.h"
#include "disflow/host/stereo_camera.h"
#include "disflow/host/time_of_flight_camera.h"

namespace disflow::host {
namespace {

class CleanCamera final : public DepthCamera {
 public:
  void Measure(int /*frame*/, const SceneView& scene, std::span<float> depth_m) override {
    std::transform(scene.inverse_depth_per_m.begin(), scene.inverse_depth_per_m.end(),
                   depth_m.begin(), [](float w) { return w > 0.0F ? 1.0F / w : 0.0F; });
  }
};

class DisparityCamera final : public DepthCamera {
 public:
  DisparityCamera(const DisparityModel& model, const SimulationOptions& options)
      : noise_(model, options.width_px, options.height_px, options.seed) {}
  void Measure(int frame, const SceneView& scene, std::span<float> depth_m) override {
    noise_.Apply(frame, scene.inverse_depth_per_m, depth_m);
  }

 private:
  SensorNoise noise_;
};

}  // namespace

std::unique_ptr<DepthCamera> MakeDepthCamera(const SimulationOptions& options) {
  const auto fx_px = static_cast<double>(SimulatedCamera(options).fx_px);
  switch (options.noise) {
    case NoiseKind::kWhite:
      return std::make_unique<DisparityCamera>(WhiteModel(fx_px), options);
    case NoiseKind::kD415:
      return std::make_unique<DisparityCamera>(D415Model(fx_px, options.width_px), options);
    case NoiseKind::kKinect:
      return std::make_unique<DisparityCamera>(KinectModel(), options);
    case NoiseKind::kTof:
      return std::make_unique<TimeOfFlightCamera>(options);
    case NoiseKind::kStereo:
    case NoiseKind::kStereoRaw:
      return std::make_unique<StereoCamera>(options);
    case NoiseKind::kClean:
      break;
  }
  return std::make_unique<CleanCamera>();
}

}  // namespace disflow::host
