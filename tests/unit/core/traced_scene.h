// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "depth_scene.h"
#include "disflow/geometry/transform.h"
#include "shapes.h"

namespace disflow::testing {

/// Draws a shape at a pose into a depth image, where it is nearer than what is there. Rays are
/// followed in steps of the distance to the shape, which never pass through it.
inline DepthScene& Trace(const Shape& shape, const PoseCameraFromObject& T_co, DepthScene& scene) {
  const PoseObjectFromCamera T_oc = T_co.Inverse();
  return scene.Draw(DepthScene::image(), [&](int u, int v) {
    constexpr float kHit_m = 2e-5F;
    const Vec3 ray =
        DepthScene::camera().Ray(static_cast<float>(u), static_cast<float>(v)).normalized();
    const float background_m = scene.At(u, v);
    float along_m = 0.0F;
    while (along_m * ray.z() < background_m) {
      const float distance_m = shape.distance_m(T_oc * Vec3(along_m * ray));
      if (distance_m < kHit_m) return along_m * ray.z();
      along_m += distance_m;
    }
    return background_m;
  });
}

}  // namespace disflow::testing
