// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/time_of_flight_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "disflow/host/image_noise.h"
#include "surface_light.h"

namespace disflow::host {
namespace {

using std::numbers::pi;

constexpr double kLight_mps = 299'792'458.0;
/// Phase per metre of the way to a surface and back.
constexpr double kPhase_radpm = 4.0 * pi * TimeOfFlightCamera::kModulation_hz / kLight_mps;

/// The fourth harmonic of the correlation function: four periods per turn of the phase.
double Wiggle(double distance_m) {
  return TimeOfFlightCamera::kWiggle_m * std::sin(4.0 * kPhase_radpm * distance_m);
}

}  // namespace

TimeOfFlightCamera::TimeOfFlightCamera(const SimulationOptions& options)
    : options_(options),
      camera_(SimulatedCamera(options)),
      cell_px_(std::max(4, options.width_px / 40)),
      columns_((options.width_px + cell_px_ - 1) / cell_px_),
      rows_((options.height_px + cell_px_ - 1) / cell_px_),
      paint_(std::make_unique<SurfacePaint>(options.seed)),
      normal_(std::make_unique<NormalTable>()),
      image_(camera_, options.width_px, options.height_px),
      phasors_(image_.labels().size()),
      mixed_(phasors_.size()),
      distance_m_(phasors_.size()) {}

TimeOfFlightCamera::~TimeOfFlightCamera() = default;

void TimeOfFlightCamera::GatherFacets(const SceneView& scene) {
  const LightOfImage light(camera_, image_, scene.surfaces, *paint_, Vec3d::Zero());
  facets_.clear();
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const int u = std::min(column * cell_px_ + cell_px_ / 2, options_.width_px - 1);
      const int v = std::min(row * cell_px_ + cell_px_ / 2, options_.height_px - 1);
      const SurfaceLight seen = light.At(u, v);
      const double distance_m = seen.position_m.norm();
      const double side_m = seen.position_m.z() * cell_px_ / static_cast<double>(camera_.fx_px);
      constexpr double kLeastCos = 0.05;
      facets_.push_back({seen.position_m, seen.normal, seen.albedo,
                         distance_m > 0.0 ? seen.cos_incidence / (distance_m * distance_m) : 0.0,
                         distance_m, side_m * side_m / std::max(kLeastCos, seen.cos_incidence),
                         image_.labels()[static_cast<std::size_t>(v * options_.width_px + u)]});
    }
  }
}

/// One reflection; light of several is weak and late. Nothing hides one facet from another.
void TimeOfFlightCamera::FindIndirectLight() {
  indirect_.assign(facets_.size(), 0.0);
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    const Facet& to = facets_[i];
    if (!(to.irradiance > 0.0)) continue;
    for (const Facet& from : facets_) {
      const Vec3d way = from.position_m - to.position_m;
      const double cos_to = to.normal.dot(way);
      const double cos_from = -from.normal.dot(way);
      if (!(cos_to > 0.0 && cos_from > 0.0)) continue;
      // Facets that touch would otherwise give each other more light than they have.
      const double squared = way.squaredNorm() + from.area_m2 / pi;
      const double reflected = from.albedo * from.irradiance * cos_to * cos_from * from.area_m2 /
                               (pi * squared * squared);
      const double detour_m = from.distance_m + std::sqrt(squared) - to.distance_m;
      indirect_[i] += std::polar(reflected / to.irradiance, 0.5 * kPhase_radpm * detour_m);
    }
  }
}

/// Interpolated between those of the four nearest facets that lie on the same surface.
std::complex<double> TimeOfFlightCamera::IndirectAt(int u, int v, std::uint32_t label) const {
  const int middle_px = cell_px_ / 2;
  const double x = (u - middle_px) / static_cast<double>(cell_px_);
  const double y = (v - middle_px) / static_cast<double>(cell_px_);
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  std::complex<double> sum = 0.0;
  double weights = 0.0;
  for (int j = 0; j < 4; ++j) {
    const int c = column + (j & 1);
    const int r = row + (j >> 1);
    if (c < 0 || r < 0 || c >= columns_ || r >= rows_) continue;
    const auto facet = static_cast<std::size_t>(r * columns_ + c);
    if (facets_[facet].label != label) continue;
    const double weight = (1.0 - std::abs(x - c)) * (1.0 - std::abs(y - r)) + 1e-6;
    sum += weight * indirect_[facet];
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : sum;
}

/// Optics and pixels that talk to each other: 12 % of the light to either side.
void TimeOfFlightCamera::MixNeighbours() {
  const float aside = 0.12F;
  const auto mix = [aside](const std::vector<std::complex<float>>& in,
                           std::vector<std::complex<float>>& out, std::size_t step) {
    out = in;
    for (std::size_t i = step; i + step < in.size(); ++i)
      out[i] = (1.0F - 2.0F * aside) * in[i] + aside * (in[i - step] + in[i + step]);
  };
  mix(phasors_, mixed_, 1);
  mix(mixed_, phasors_, static_cast<std::size_t>(options_.width_px));
}

void TimeOfFlightCamera::Measure(int frame, const SceneView& scene, std::span<float> depth_m) {
  scene.draw_from(Vec3d::Zero(), image_);
  GatherFacets(scene);
  FindIndirectLight();
  const LightOfImage light(camera_, image_, scene.surfaces, *paint_, Vec3d::Zero());
  for (int v = 0; v < options_.height_px; ++v) {
    for (int u = 0; u < options_.width_px; ++u) {
      const auto pixel = static_cast<std::size_t>(v * options_.width_px + u);
      const SurfaceLight seen = light.At(u, v);
      const double distance_m = seen.position_m.norm();
      distance_m_[pixel] = static_cast<float>(distance_m);
      phasors_[pixel] = 0.0F;
      if (!(distance_m > 0.0)) continue;
      const std::complex<double> direct = std::polar(
          seen.albedo * seen.cos_incidence / (distance_m * distance_m), kPhase_radpm * distance_m);
      phasors_[pixel] =
          std::complex<float>(direct * (1.0 + IndirectAt(u, v, image_.labels()[pixel])));
    }
  }
  MixNeighbours();
  constexpr std::uint64_t kFirstStream = 4'000'000;  // clear of all others
  RandomNumbers random(options_.seed, kFirstStream + static_cast<std::uint64_t>(frame));
  BitSource bits(random);
  for (std::size_t pixel = 0; pixel < depth_m.size(); ++pixel) {
    const float in_phase = normal_->Draw(bits);
    const float quadrature = normal_->Draw(bits);
    const std::complex<double> phasor(phasors_[pixel] + static_cast<float>(kPhasorStd) *
                                                            std::complex(in_phase, quadrature));
    depth_m[pixel] = 0.0F;
    const auto true_m = static_cast<double>(distance_m_[pixel]);
    if (!(true_m > 0.0) || std::abs(phasor) < kLeastAmplitude) continue;
    // Relative to the true phase, since which turn of the phase it is, such cameras find out by
    // measuring with several frequencies.
    const double error_rad = std::arg(phasor * std::polar(1.0, -kPhase_radpm * true_m));
    const double measured_m = true_m + error_rad / kPhase_radpm;
    const double stretch = (measured_m + Wiggle(measured_m)) / true_m;
    depth_m[pixel] =
        static_cast<float>(stretch / static_cast<double>(scene.inverse_depth_per_m[pixel]));
  }
}

}  // namespace disflow::host
