// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "disflow/host/depth_renderer.h"
#include "disflow/host/simulation_options.h"

namespace disflow::host {

/// A surface with a paint that moves along with it.
struct PaintedSurface {
  std::uint32_t label = 0;
  /// From the camera to the frame that the paint is fixed to.
  Transform<Object, Camera, double> T_sc;
};

/// What stands before a camera at one moment.
struct SceneView {
  /// 1/z of every pixel, row-major; 0 = nothing there.
  std::span<const float> inverse_depth_per_m;
  std::span<const std::uint32_t> labels;
  std::span<const PaintedSurface> surfaces;
  /// Draws the scene as seen from another place, with the camera's axes; the renderer is cleared
  /// first.
  std::function<void(const Vec3d& eye_m, DepthRenderer& renderer)> draw_from;
};

/// A simulated depth camera: turns what is there into what it measures. What frame k shows depends
/// on the seed, the scene and k only.
class DepthCamera {
 public:
  DepthCamera() = default;
  DepthCamera(const DepthCamera&) = delete;
  DepthCamera& operator=(const DepthCamera&) = delete;
  virtual ~DepthCamera() = default;

  /// @param depth_m As many pixels as the scene's; 0 = no data.
  virtual void Measure(int frame, const SceneView& scene, std::span<float> depth_m) = 0;
  /// The left infrared image of the frame measured last, 8 bits; empty where the camera has none.
  [[nodiscard]] virtual std::span<const std::uint8_t> infrared() const { return {}; }
};

/// The camera that the options name.
/// @throws std::runtime_error if it needs OpenCV and the program was built without.
[[nodiscard]] std::unique_ptr<DepthCamera> MakeDepthCamera(const SimulationOptions& options);

}  // namespace disflow::host
