// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_choice.h"

#include <algorithm>
#include <cmath>

namespace disflow::apps {
namespace {

/// The pixel at a share of a side; the far end belongs to the last one. Written so that NaN is
/// none.
std::optional<int> PixelAtShare(float share, int side_px) noexcept {
  if (!(share >= 0.0F && share <= 1.0F)) return std::nullopt;
  return std::min(static_cast<int>(share * static_cast<float>(side_px)), side_px - 1);
}

std::optional<ObjectStart> AtPixel(const DepthView& image, float u, float v, float reach) noexcept {
  const std::optional<int> u_px = PixelAtShare(u, image.width_px);
  const std::optional<int> v_px = PixelAtShare(v, image.height_px);
  if (!u_px || !v_px || !(reach >= 0.0F && reach <= 1.0F)) return std::nullopt;
  ObjectStart start;
  start.seed_u_px = *u_px;
  start.seed_v_px = *v_px;
  start.seed_reach_px = static_cast<int>(reach * static_cast<float>(image.width_px));
  return start;
}

/// The part of the box that lies in the image.
std::optional<ObjectStart> InBox(const DepthView& image, const ObjectChoice& choice) noexcept {
  const std::optional<int> left_px = PixelAtShare(choice.u, image.width_px);
  const std::optional<int> top_px = PixelAtShare(choice.v, image.height_px);
  if (!left_px || !top_px || !(choice.width > 0.0F && choice.height > 0.0F)) return std::nullopt;
  const auto length_px = [](float share, int side_px) {
    return std::max(1, static_cast<int>(std::min(share, 1.0F) * static_cast<float>(side_px)));
  };
  ObjectStart start;
  start.roi_x_px = *left_px;
  start.roi_y_px = *top_px;
  start.roi_width_px = length_px(choice.width, image.width_px);
  start.roi_height_px = length_px(choice.height, image.height_px);
  return start;
}

std::optional<ObjectStart> AtPoint(const DepthFrame& frame, const ObjectChoice& choice) noexcept {
  // A hand's breadth would reach the neighbour; the object may have moved on a little since.
  constexpr float kReach_m = 0.03F;
  if (choice.in_world && !frame.has_T_wc) return std::nullopt;
  const Vec3 x_c = choice.in_world ? frame.T_wc.Inverse() * choice.point_m : choice.point_m;
  if (!x_c.allFinite() || !(x_c.z() > 0.0F)) return std::nullopt;
  const Vec2 pixel = frame.camera.Project(x_c);
  const auto width_px = static_cast<float>(frame.depth.width_px);
  const auto height_px = static_cast<float>(frame.depth.height_px);
  const float reach_px = frame.camera.fx_px * kReach_m / x_c.z();
  // Pixel centres are at integer coordinates.
  return AtPixel(frame.depth, (pixel.x() + 0.5F) / width_px, (pixel.y() + 0.5F) / height_px,
                 std::min(reach_px / width_px, 1.0F));
}

bool Fits(const DepthView& image, const ObjectChoice& choice) noexcept {
  const auto pixels =
      static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
  return choice.mask_width_px == image.width_px && choice.mask_height_px == image.height_px &&
         choice.mask.size() == pixels;
}

}  // namespace

std::optional<ObjectStart> StartIn(const DepthFrame& frame, const ObjectChoice& choice) noexcept {
  switch (choice.kind) {
    case ObjectChoice::Kind::kPixel:
      return AtPixel(frame.depth, choice.u, choice.v, choice.reach);
    case ObjectChoice::Kind::kBox:
      return InBox(frame.depth, choice);
    case ObjectChoice::Kind::kPoint:
      return AtPoint(frame, choice);
    case ObjectChoice::Kind::kMask:
      break;
  }
  if (!Fits(frame.depth, choice)) return std::nullopt;
  return ObjectStart{};
}

ChosenMasks MasksOf(const DepthFrame& frame, const ObjectStart& start,
                    const ChosenMasks& before) noexcept {
  if (!frame.mask.given()) return {};
  const bool is_pixel = start.seed_u_px >= 0;
  const int u = is_pixel ? start.seed_u_px : start.roi_x_px + start.roi_width_px / 2;
  const int v = is_pixel ? start.seed_v_px : start.roi_y_px + start.roi_height_px / 2;
  if (u >= frame.mask.width_px || v >= frame.mask.height_px) return {};
  const std::uint8_t value = frame.mask.row(v)[u];
  if (value == 0) return {};
  // Masks of one object may have several values, 255 and what an image codec makes of it.
  return {true, before.label == 0 ? std::uint8_t{0} : value};
}

}  // namespace disflow::apps
