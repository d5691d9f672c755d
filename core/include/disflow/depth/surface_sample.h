// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// A measured piece of surface. The frame (camera or object) is said where it is used.
struct SurfaceSample {
  Vec3 position_m = Vec3::Zero();
  Vec3 normal = Vec3::Zero();  ///< Unit length, towards the camera that saw it.
  float variance_m2 = 0.0F;    ///< Of the position along the normal, this sample's own pixels only.
  float fused_variance_m2 =
      0.0F;                      ///< Same, of the whole fitted window: what the model may believe.
  float normal_variance = 0.0F;  ///< Per tangential component [rad^2].
  /// Half the diagonal of its block of pixels, across the viewing ray: as far as a point of surface
  /// that faces the camera may lie from the nearest such sample. 0 if no camera saw it.
  float reach_m = 0.0F;
};

/// A point where a steady surface ends in front of something farther away.
struct EdgePoint {
  Vec3 position_m = Vec3::Zero();
  Vec3 direction = Vec3::Zero();  ///< Unit tangent of the edge; its sign has no meaning.
  Vec3 normal = Vec3::Zero();     ///< Of the surface that ends here.
  Vec3 ray = Vec3::Zero();        ///< Unit viewing direction.
  /// Unit vector away from the object, across ray and edge: all that the image shows of the place.
  Vec3 outward = Vec3::Zero();
  float variance_m2 = 0.0F;        ///< Of the position along `outward`.
  float depth_variance_m2 = 0.0F;  ///< Of the position along the ray.
  float bend_m = 0.0F;             ///< See ContourBend().
  /// The surface beside it is flat beyond doubt. Other points make no edges, but find known ones.
  bool steady = true;
};

/// An edge of the camera frame in the object frame.
[[nodiscard]] EdgePoint operator*(const PoseObjectFromCamera& T_oc,
                                  const EdgePoint& point) noexcept;

}  // namespace disflow
