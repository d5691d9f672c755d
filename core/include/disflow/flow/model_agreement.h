// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "disflow/depth/depth_reader.h"
#include "disflow/geometry/pinhole_camera.h"
#include "disflow/geometry/transform.h"

namespace disflow {

/// What a depth image says of the surface that a pose claims to be in view. The registration only
/// knows how well the model explains what was observed; this is the reverse, and it sees what the
/// registration cannot: surface that should be there and is not.
struct ModelAgreement {
  int seen = 0;          ///< Model points where the image shows surface as it should.
  int contradicted = 0;  ///< Model points that the image looks through.
  int hidden = 0;        ///< Behind something nearer, or without depth.
  int outside = 0;       ///< Out of the image.

  [[nodiscard]] int facing() const noexcept { return seen + contradicted + hidden + outside; }
  /// Share of the decided points that contradict the pose, 0..1.
  [[nodiscard]] float conflict() const noexcept {
    const int decided = seen + contradicted;
    return decided == 0 ? 0.0F : static_cast<float>(contradicted) / static_cast<float>(decided);
  }
  /// Share of the points facing the camera that are seen or contradicted, 0..1.
  [[nodiscard]] float visible() const noexcept {
    const int all = facing();
    return all == 0 ? 0.0F : static_cast<float>(seen + contradicted) / static_cast<float>(all);
  }
};

/// Whether surface at some depth is close beside a place in the image. What ends a little beyond
/// the object's outline does so because of the pose, or of a ragged outline.
/// @param reach_m How far beside it.
[[nodiscard]] bool IsBesideSurface(const DepthReader& depth, const PinholeCamera& camera,
                                   const Vec2& px, float depth_m, float reach_m,
                                   float tolerance_m) noexcept;

/// Looks up the centres of the model's local GPs that face the camera.
/// @param on_decided on_decided(handle, seen) for each cluster that was seen, or looked through.
template <class Field, class OnDecided>
[[nodiscard]] ModelAgreement CompareWithImage(const Field& field, const PoseObjectFromCamera& T_oc,
                                              const PinholeCamera& camera, const DepthReader& depth,
                                              OnDecided&& on_decided) noexcept {
  constexpr float kMinCosine = 0.3F;
  constexpr float kToleranceFloor_m = 0.006F;
  constexpr float kTolerancePerMetre = 0.01F;
  // The samples of the model are as far apart.
  const float beside_m = field.config().merge_radius_m;
  const PoseCameraFromObject T_co = T_oc.Inverse();
  const Vec3& eye_o = T_oc.translation();
  ModelAgreement agreement;
  field.store().ForEach([&](auto handle, const auto& cluster) {
    const Vec3 to_eye = eye_o - cluster.centroid_m;
    if (cluster.mean_normal.dot(to_eye) < kMinCosine * to_eye.norm()) return;
    const Vec3 x_c = T_co * cluster.centroid_m;
    if (!(x_c.z() > 0.0F)) return;
    const Vec2 px = camera.Project(x_c);
    if (!(px.x() >= 0.0F && px.y() >= 0.0F && px.x() < static_cast<float>(depth.width_px() - 1) &&
          px.y() < static_cast<float>(depth.height_px() - 1))) {
      ++agreement.outside;
      return;
    }
    const PixelAt nearest(px);
    const float depth_m = depth.At(nearest.u, nearest.v);
    const float tolerance_m = kToleranceFloor_m + kTolerancePerMetre * x_c.z();
    const bool looked_through = depth_m > x_c.z() + tolerance_m;
    if (depth_m <= 0.0F || depth_m < x_c.z() - tolerance_m ||
        (looked_through && IsBesideSurface(depth, camera, px, x_c.z(), beside_m, tolerance_m))) {
      ++agreement.hidden;
    } else if (looked_through) {
      ++agreement.contradicted;
      on_decided(handle, false);
    } else {
      ++agreement.seen;
      on_decided(handle, true);
    }
  });
  return agreement;
}

template <class Field>
[[nodiscard]] ModelAgreement CompareWithImage(const Field& field, const PoseObjectFromCamera& T_oc,
                                              const PinholeCamera& camera,
                                              const DepthReader& depth) noexcept {
  return CompareWithImage(field, T_oc, camera, depth, [](auto, bool) {});
}

}  // namespace disflow
