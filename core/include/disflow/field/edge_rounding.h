// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/types.h"

namespace disflow {

/// What is expected of a radius at first, and its standard deviation: from a sharp edge to that of
/// a cushion everything is likely.
inline constexpr float kExpectedRadius_m = 0.003F;

/// How much the edges of an object are rounded: one radius for all of them, estimated together with
/// the pose. What people hold has edges rounded by some millimetres, and the outline of such an
/// edge wanders over it as the object turns, by up to 0.41 radii; a pose that takes it for a sharp
/// edge slides as far.
struct EdgeRounding {
  float radius_m = kExpectedRadius_m;
  float variance_m2 = kExpectedRadius_m * kExpectedRadius_m;  ///< Of the radius.
};

/// Where the outline of a rounded edge is, across ray and edge, seen from the place where the faces
/// would meet if it were sharp, in radii. The support function of a rounded right angle: zero where
/// a face is seen from straight ahead or edge-on, negative (towards the object) in between.
/// @param outward Unit vector away from the object, across ray and edge.
/// @param normal Of either of the faces that end at the edge: it is the same.
[[nodiscard]] inline float OutlineOffset(const Vec3& outward, const Vec3& normal) noexcept {
  const float sine = std::min(1.0F, std::max(0.0F, outward.dot(normal)));
  return 1.0F - sine - std::sqrt(1.0F - sine * sine);
}

/// What is remembered of the rounding after a frame. The errors of the model's edges are the same
/// for as many frames as an edge averages over: all these together tell no more than one of them.
/// @param before What was known of it when the frame came.
/// @param by_frame The estimate with the frame.
[[nodiscard]] EdgeRounding Remember(const EdgeRounding& before,
                                    const EdgeRounding& by_frame) noexcept;

}  // namespace disflow
