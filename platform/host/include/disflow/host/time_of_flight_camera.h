// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <complex>
#include <memory>
#include <vector>

#include "disflow/host/depth_camera.h"

namespace disflow::host {

class SurfacePaint;
class NormalTable;

/// A camera that measures the phase of modulated light. Each pixel gathers a phasor, amplitude and
/// phase of the light that comes back:
/// - the amplitude follows paint, angle and distance; a phasor's noise is the same everywhere, so
///   that dark, far and slanted surfaces are noisy, and the darkest give no data;
/// - pixels at outlines mix the phasors of both sides (flying pixels);
/// - light that reaches a surface by way of another one makes corners seem farther;
/// - the modulation is no pure sine: the distance "wiggles" about the true one.
class TimeOfFlightCamera final : public DepthCamera {
 public:
  explicit TimeOfFlightCamera(const SimulationOptions& options);
  ~TimeOfFlightCamera() override;
  void Measure(int frame, const SceneView& scene, std::span<float> depth_m) override;

  static constexpr double kModulation_hz = 80e6;
  static constexpr double kWiggle_m = 0.002;   ///< Amplitude.
  static constexpr double kPhasorStd = 0.005;  ///< Of each part; white, facing at 1 m is 1.
  static constexpr double kLeastAmplitude = 0.03;

 private:
  /// A piece of surface that light may be reflected by.
  struct Facet {
    Vec3d position_m;
    Vec3d normal;
    double albedo;
    double irradiance;
    double distance_m;
    double area_m2;
    std::uint32_t label;
  };
  void GatherFacets(const SceneView& scene);
  void FindIndirectLight();
  [[nodiscard]] std::complex<double> IndirectAt(int u, int v, std::uint32_t label) const;
  void MixNeighbours();

  SimulationOptions options_;
  PinholeCamera camera_;
  int cell_px_;
  int columns_;
  int rows_;
  std::unique_ptr<SurfacePaint> paint_;
  std::unique_ptr<NormalTable> normal_;
  DepthRenderer image_;
  std::vector<Facet> facets_;
  std::vector<std::complex<double>> indirect_;  ///< Of each facet, relative to its direct light.
  std::vector<std::complex<float>> phasors_;
  std::vector<std::complex<float>> mixed_;
  std::vector<float> distance_m_;
};

}  // namespace disflow::host
