// SPDX-License-Identifier: BSD-3-Clause
#include "surface_light.h"

#include <algorithm>
#include <cmath>

#include "disflow/host/random.h"

namespace disflow::host {
namespace {

constexpr int kLattice = 32;  // a power of two: the lattice repeats

std::size_t LatticeIndex(int x, int y, int z) {
  constexpr unsigned kMask = kLattice - 1;
  return ((static_cast<unsigned>(z) & kMask) * kLattice + (static_cast<unsigned>(y) & kMask)) *
             kLattice +
         (static_cast<unsigned>(x) & kMask);
}

}  // namespace

SurfacePaint::SurfacePaint(std::uint64_t seed)
    : lattice_(std::size_t{kLattice} * kLattice * kLattice) {
  constexpr std::uint64_t kStream = 11;
  RandomNumbers random(seed, kStream);
  for (float& value : lattice_) value = static_cast<float>(random.Uniform(-1.0, 1.0));
}

float SurfacePaint::Grain(float x, float y, float z) const {
  const auto below = [](float value) {
    const int whole = static_cast<int>(value);
    return static_cast<float>(whole) > value ? whole - 1 : whole;
  };
  const int x0 = below(x);
  const int y0 = below(y);
  const int z0 = below(z);
  const float fx = x - static_cast<float>(x0);
  const float fy = y - static_cast<float>(y0);
  const float fz = z - static_cast<float>(z0);
  const auto along_x = [&](int row, int layer) {
    const float a = lattice_[LatticeIndex(x0, row, layer)];
    return a + fx * (lattice_[LatticeIndex(x0 + 1, row, layer)] - a);
  };
  const auto along_y = [&](int layer) {
    const float a = along_x(y0, layer);
    return a + fy * (along_x(y0 + 1, layer) - a);
  };
  const float a = along_y(z0);
  return a + fz * (along_y(z0 + 1) - a);
}

float SurfacePaint::AlbedoAt(std::uint32_t label, const Vec3d& x_s_m) const {
  // Patches, print and grain. Coprime to the lattice, so that it does not repeat before long.
  constexpr float kPatches_per_m = 47.0F;
  constexpr float kPrint_per_m = 173.0F;
  constexpr float kGrain_per_m = 401.0F;
  const Vec3 x = x_s_m.cast<float>() + Vec3::Constant(0.37F * static_cast<float>(label % 64U));
  const auto grain = [&](float per_m) {
    return Grain(per_m * x.x(), per_m * x.y(), per_m * x.z());
  };
  const float albedo = 0.55F + 0.35F * grain(kPatches_per_m) + 0.25F * grain(kPrint_per_m) +
                       0.2F * grain(kGrain_per_m);
  return std::clamp(albedo, 0.1F, 0.95F);
}

LightOfImage::LightOfImage(const PinholeCamera& camera, const DepthRenderer& image,
                           std::span<const PaintedSurface> surfaces, const SurfacePaint& paint,
                           const Vec3d& eye_m)
    : camera_(camera), image_(image), surfaces_(surfaces), paint_(paint), eye_m_(eye_m) {}

const PaintedSurface* LightOfImage::SurfaceOf(std::uint32_t label) const {
  for (const PaintedSurface& surface : surfaces_) {
    if (surface.label == label) return &surface;
  }
  return nullptr;
}

/// Change of 1/z from pixel to pixel, on the side where the surface goes on.
double LightOfImage::Slope(std::size_t pixel, int at, int count, std::size_t step) const {
  const std::span<const float> w = image_.inverse_depth_per_m();
  const auto change = [&](std::size_t from, std::size_t to) {
    return static_cast<double>(w[to]) - static_cast<double>(w[from]);
  };
  const bool has_next = at + 1 < count;
  const bool has_last = at > 0;
  const double next = has_next ? change(pixel, pixel + step) : 0.0;
  const double last = has_last ? change(pixel - step, pixel) : next;
  if (!has_next) return last;
  return std::abs(next) < std::abs(last) ? next : last;
}

SurfaceLight LightOfImage::At(int u, int v) const {
  SurfaceLight light;
  const int width = image_.width_px();
  const std::size_t pixel =
      static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  const auto w = static_cast<double>(image_.inverse_depth_per_m()[pixel]);
  if (!(w > 0.0)) return light;
  const Vec3d ray = camera_.Ray(static_cast<float>(u), static_cast<float>(v)).cast<double>();
  // On a plane n x = d, 1/z is the affine function (n/d) ray; its slopes give n/d.
  const double nx = static_cast<double>(camera_.fx_px) * Slope(pixel, u, width, 1);
  const double ny = static_cast<double>(camera_.fy_px) *
                    Slope(pixel, v, image_.height_px(), static_cast<std::size_t>(width));
  const Vec3d away(nx, ny, w - nx * ray.x() - ny * ray.y());
  const double length = away.norm();
  light.position_m = ray / w;
  light.normal = -away / length;
  light.cos_incidence = w / (length * ray.norm());
  const std::uint32_t label = image_.labels()[pixel];
  const PaintedSurface* surface = SurfaceOf(label);
  if (surface != nullptr)
    light.albedo = static_cast<double>(
        paint_.AlbedoAt(label, surface->T_sc * Vec3d(light.position_m + eye_m_)));
  return light;
}

}  // namespace disflow::host
