// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/mask_disturbance.h"

#include <cmath>
#include <numbers>

#include "disflow/host/random.h"
#include "mask_morphology.h"
#include "scene_label.h"

namespace disflow::host {
namespace {

struct Pixel {
  int u = 0;
  int v = 0;
};

Pixel PixelAt(std::size_t index, int width_px) {
  const auto pixel = static_cast<int>(index);
  return {pixel % width_px, pixel / width_px};
}

}  // namespace

MaskDisturbance::MaskDisturbance(const SimulationOptions& options, std::size_t object)
    : options_(options),
      seed_(options.seed + 1000 * object),
      rows_(static_cast<std::size_t>(options.width_px) *
            static_cast<std::size_t>(options.height_px)) {}

MaskDisturbance::Extent MaskDisturbance::ExtentOf(std::span<const std::uint8_t> mask) const {
  Extent extent;
  double count = 0.0;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) continue;
    const auto [u, v] = PixelAt(i, options_.width_px);
    extent.u += u;
    extent.v += v;
    count += 1.0;
  }
  if (count == 0.0) return extent;
  extent.u /= count;
  extent.v /= count;
  extent.radius = std::sqrt(count / std::numbers::pi);
  return extent;
}

/// A disc at the outline that creeps round the object, once in some ten seconds. All of an arm or a
/// hand that is near goes in too.
void MaskDisturbance::Leak(int frame, std::span<const std::uint32_t> labels,
                           std::vector<std::uint8_t>& mask) const {
  const Extent extent = ExtentOf(mask);
  if (extent.radius == 0.0) return;
  RandomNumbers random(seed_, 15);
  const double start_rad = random.Uniform(0.0, 2.0 * std::numbers::pi);
  constexpr double kTurn_rad = 0.02;  // per frame
  const double angle = start_rad + kTurn_rad * frame;
  const double leak_u = extent.u + extent.radius * std::cos(angle);
  const double leak_v = extent.v + extent.radius * std::sin(angle);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const auto [u, v] = PixelAt(i, options_.width_px);
    const bool near_leak = std::hypot(u - leak_u, v - leak_v) < 0.5 * extent.radius;
    const bool near_hand = labels[i] == SceneLabel::kOccluder &&
                           std::hypot(u - extent.u, v - extent.v) < 1.5 * extent.radius;
    if (near_leak || near_hand) mask[i] = 255;
  }
}

/// Leaves what is on one side of a line through the object.
void MaskDisturbance::CutOff(double angle_rad, std::vector<std::uint8_t>& mask) const {
  const Extent extent = ExtentOf(mask);
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const auto [u, v] = PixelAt(i, options_.width_px);
    const double along =
        (u - extent.u) * std::cos(angle_rad) + (v - extent.v) * std::sin(angle_rad);
    if (along > 0.0) mask[i] = 0;
  }
}

bool MaskDisturbance::Apply(int frame, std::span<const std::uint32_t> labels,
                            std::vector<std::uint8_t>& mask) {
  if (options_.mask == MaskKind::kLeaking) Leak(frame, labels, mask);
  if (options_.mask_grow_px != 0)
    SpreadMask(options_.mask_grow_px, options_.width_px, options_.height_px, rows_, mask);
  constexpr std::uint64_t kFirstStream = 8'000'000;  // clear of all others
  RandomNumbers random(seed_, kFirstStream + static_cast<std::uint64_t>(frame));
  // The first mask says what is to be tracked.
  if (frame == 0 || random.Uniform() >= options_.mask_flicker) return true;
  const bool missing = random.Uniform() < 0.5;
  if (!missing) CutOff(random.Uniform(0.0, 2.0 * std::numbers::pi), mask);
  return !missing;
}

}  // namespace disflow::host
