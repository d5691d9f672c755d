// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"

namespace disflow {

/// The same rotation, with the observed centroid put onto the centroid of the model's part that
/// faces the camera: where an object is of which nothing but its pixels is known.
/// @param center_c Mean of the observed points, camera frame.
/// @return The pose as it is if no part of the model faces the camera.
template <class Field>
[[nodiscard]] PoseObjectFromCamera Recentred(const Field& field, const PoseObjectFromCamera& T_oc,
                                             const Vec3& center_c) noexcept {
  constexpr float kMinCosine = 0.3F;
  Vec3 sum = Vec3::Zero();
  float count = 0.0F;
  const Vec3& eye_o = T_oc.translation();
  field.store().ForEach([&](auto, const auto& cluster) {
    const Vec3 to_eye = eye_o - cluster.centroid_m;
    // What is seen at too flat an angle is not among the samples.
    if (cluster.mean_normal.dot(to_eye) < kMinCosine * to_eye.norm()) return;
    const auto samples = static_cast<float>(cluster.samples.size());
    sum += samples * cluster.centroid_m;
    count += samples;
  });
  if (count < 1.0F) return T_oc;
  const Vec3 shift = sum / count - T_oc * center_c;
  return {T_oc.rotation(), Vec3(T_oc.translation() + shift)};
}

}  // namespace disflow
