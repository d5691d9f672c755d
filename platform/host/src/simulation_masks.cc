// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "disflow/host/simulation.h"
#include "scene_label.h"

/// @file
/// The masks of the simulated camera's images.

namespace disflow::host {
namespace {

void Extract(std::span<const std::uint32_t> labels, std::uint32_t label,
             std::vector<std::uint8_t>& mask) {
  std::transform(labels.begin(), labels.end(), mask.begin(), [label](std::uint32_t seen) {
    return static_cast<std::uint8_t>(seen == label ? 255 : 0);
  });
}

void Mark(std::span<const std::uint8_t> mask, std::uint8_t value, std::vector<std::uint8_t>& all) {
  for (std::size_t pixel = 0; pixel < all.size(); ++pixel)
    if (mask[pixel] != 0) all[pixel] = value;
}

}  // namespace

void Simulation::DrawMasks(int index) {
  if (late_) DrawScene(std::max(0, index - options_.mask_delay), Vec3d::Zero(), *late_);
  const std::span<const std::uint32_t> labels = renderer_.labels();
  std::fill(gt_mask_.begin(), gt_mask_.end(), std::uint8_t{0});
  std::fill(sloppy_mask_.begin(), sloppy_mask_.end(), std::uint8_t{0});
  // The nearest last, so that it wins where inexact masks overlap.
  for (std::size_t i = bodies_.size(); i-- > 0;) {
    const auto label = SceneLabel::kFirstObject + static_cast<std::uint32_t>(i);
    const auto value = static_cast<std::uint8_t>(bodies_.size() == 1 ? 255U : label);
    Extract(labels, label, exact_);
    Mark(exact_, value, gt_mask_);
    if (late_) Extract(late_->labels(), label, exact_);
    bodies_[i].sloppy.Update(index, exact_);
    Mark(bodies_[i].sloppy.mask(), value, sloppy_mask_);
  }
}

void Simulation::DisturbMasks(int index) {
  const int seen = std::max(0, index - options_.mask_delay);
  const DepthRenderer& renderer = late_ ? *late_ : renderer_;
  std::fill(disturbed_mask_.begin(), disturbed_mask_.end(), std::uint8_t{0});
  mask_missing_ = true;
  for (std::size_t i = bodies_.size(); i-- > 0;) {
    const auto label = SceneLabel::kFirstObject + static_cast<std::uint32_t>(i);
    const auto value = static_cast<std::uint8_t>(bodies_.size() == 1 ? 255U : label);
    Extract(renderer.labels(), label, exact_);
    if (options_.mask == MaskKind::kSloppy) {
      const std::span<const std::uint8_t> sloppy = bodies_[i].sloppy.mask();
      exact_.assign(sloppy.begin(), sloppy.end());
    }
    if (!bodies_[i].disturbance.Apply(seen, renderer.labels(), exact_)) continue;
    mask_missing_ = false;
    Mark(exact_, value, disturbed_mask_);
  }
}

MaskView Simulation::mask() const {
  if (options_.mask == MaskKind::kNone) return {};
  if (!HasDisturbedMask()) return options_.mask == MaskKind::kGt ? gt_mask() : sloppy_mask();
  return mask_missing_ ? MaskView{} : ViewOf(disturbed_mask_);
}

bool Simulation::HasDisturbedMask() const {
  return options_.mask == MaskKind::kLeaking || options_.mask_delay > 0 ||
         options_.mask_grow_px != 0 || options_.mask_flicker > 0.0;
}

}  // namespace disflow::host
