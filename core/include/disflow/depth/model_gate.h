// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/depth/model_prior.h"
#include "disflow/depth/pixel_mask.h"
#include "disflow/geometry/pinhole_camera.h"
#include "disflow/geometry/transform.h"

namespace disflow {

/// Accepts the pixels whose points lie within the model's bounds plus a margin.
class ModelGate {
 public:
  ModelGate(const PinholeCamera& camera, const ModelPrior& prior, float margin_m) noexcept
      : camera_(camera),
        prior_(prior),
        half_m_(0.5F * (prior.box_max_m - prior.box_min_m) + Vec3::Constant(margin_m)),
        offset_m_(prior.T_oc.translation() - 0.5F * (prior.box_max_m + prior.box_min_m)),
        step_(prior.T_oc.rotation().col(0) / camera.fx_px) {}

  /// Sets the depth of pixels that are not accepted to 0. Most parts of a row are accepted or not
  /// as a whole.
  void operator()(int v, int u_begin, int u_end, float* depth_m) const noexcept {
    const Vec3 start =
        prior_.T_oc.rotation() * camera_.Ray(static_cast<float>(u_begin), static_cast<float>(v));
    const int count = u_end - u_begin;
    for (int begin = 0; begin < count; begin += kPart_px) {
      const int end = std::min(begin + kPart_px, count);
      switch (end - begin == kPart_px ? Judge(start, begin, depth_m) : Part::kMixed) {
        case Part::kAccepted:
          break;
        case Part::kRefused:
          std::fill(depth_m + begin, depth_m + end, 0.0F);
          break;
        case Part::kMixed:
          GateEach(start, begin, end, depth_m);
      }
    }
  }

  /// Whether a single point, camera frame, is accepted.
  [[nodiscard]] bool Accepts(const Vec3& x_c) const noexcept {
    const Vec3 x_o = prior_.T_oc.rotation() * x_c + offset_m_;
    return (x_o.cwiseAbs().array() <= half_m_.array()).all();
  }

  /// The part of the image where accepted pixels can be.
  [[nodiscard]] PixelBox SearchBox(float min_range_m, const PixelBox& image) const noexcept {
    const PoseCameraFromObject T_co = prior_.T_oc.Inverse();
    // Nearer than any camera sees; pixels of points at depth 0 are not numbers.
    constexpr float kNearest_m = 1e-3F;
    const float nearest_m = std::max(min_range_m, kNearest_m);
    Vec2 low(1e9F, 1e9F);
    Vec2 high(-1e9F, -1e9F);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 sign(corner & 1 ? 1.0F : -1.0F, corner & 2 ? 1.0F : -1.0F,
                      corner & 4 ? 1.0F : -1.0F);
      const Vec3 x_c = T_co * Vec3(0.5F * (prior_.box_max_m + prior_.box_min_m) +
                                   Vec3(sign.array() * half_m_.array()));
      if (!(x_c.z() >= nearest_m)) return image;
      const Vec2 px = camera_.Project(x_c);
      low = low.cwiseMin(px);
      high = high.cwiseMax(px);
    }
    const auto clamp = [](float px, int high_px) {
      return static_cast<int>(std::min(std::max(px, 0.0F), static_cast<float>(high_px)));
    };
    return {clamp(low.x(), image.u_max), clamp(low.y(), image.v_max),
            clamp(high.x() + 1.0F, image.u_max), clamp(high.y() + 1.0F, image.v_max)};
  }

 private:
  enum class Part { kAccepted, kRefused, kMixed };
  static constexpr int kPart_px = 32;

  /// Of a whole part of a row, by its nearest and farthest depth at its two ends: coordinates grow
  /// or fall with depth and column alike, rounding included.
  /// @param start Direction through the row's first pixel, object frame.
  [[nodiscard]] Part Judge(const Vec3& start, int begin, const float* depth_m) const noexcept {
    const Eigen::Map<const Eigen::Array<float, kPart_px, 1>> depths_m(depth_m + begin);
    const float farthest_m = depths_m.maxCoeff();
    if (farthest_m <= 0.0F) return Part::kRefused;
    const float nearest_m = depths_m.minCoeff();
    if (nearest_m <= 0.0F) return Part::kMixed;  // has holes
    const auto first = static_cast<float>(begin);
    const auto last = static_cast<float>(begin + kPart_px - 1);
    bool accepted = true;
    for (int axis = 0; axis < 3; ++axis) {
      const float at_first = start[axis] + first * step_[axis];
      const float at_last = start[axis] + last * step_[axis];
      const Vec4 corners_m(
          nearest_m * at_first + offset_m_[axis], nearest_m * at_last + offset_m_[axis],
          farthest_m * at_first + offset_m_[axis], farthest_m * at_last + offset_m_[axis]);
      const float low_m = corners_m.minCoeff();
      const float high_m = corners_m.maxCoeff();
      if (low_m > half_m_[axis] || high_m < -half_m_[axis]) return Part::kRefused;
      accepted = accepted && low_m >= -half_m_[axis] && high_m <= half_m_[axis];
    }
    return accepted ? Part::kAccepted : Part::kMixed;
  }

  /// Pixel by pixel: a point is affine in the pixel's column.
  void GateEach(const Vec3& start, int begin, int end, float* depth_m) const noexcept {
    // Copies, which the row that is written cannot overlap.
    const float start_x = start.x(), start_y = start.y(), start_z = start.z();
    const float step_x = step_.x(), step_y = step_.y(), step_z = step_.z();
    const float offset_x_m = offset_m_.x(), offset_y_m = offset_m_.y(), offset_z_m = offset_m_.z();
    const float half_x_m = half_m_.x(), half_y_m = half_m_.y(), half_z_m = half_m_.z();
    for (int i = begin; i < end; ++i) {
      const auto u = static_cast<float>(i);
      const float z = depth_m[i];
      const float x_m = z * (start_x + u * step_x) + offset_x_m;
      const float y_m = z * (start_y + u * step_y) + offset_y_m;
      const float z_m = z * (start_z + u * step_z) + offset_z_m;
      const int inside = int{std::abs(x_m) <= half_x_m} & int{std::abs(y_m) <= half_y_m} &
                         int{std::abs(z_m) <= half_z_m};
      depth_m[i] = inside != 0 ? z : 0.0F;
    }
  }

  const PinholeCamera& camera_;
  const ModelPrior& prior_;
  Vec3 half_m_;
  Vec3 offset_m_;
  Vec3 step_;
};

}  // namespace disflow
