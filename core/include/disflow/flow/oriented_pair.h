// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/geometry/transform.h"
#include "disflow/types.h"

namespace disflow {

/// Two points of a surface with their normals. How far apart they are and how the normals stand to
/// the line between them and to each other is the same in every frame.
struct OrientedPair {
  Vec3 a_m = Vec3::Zero();
  Vec3 normal_a = Vec3::UnitZ();
  Vec3 b_m = Vec3::Zero();
  Vec3 normal_b = Vec3::UnitZ();
  float distance_m = 0.0F;
  Vec3 line = Vec3::Zero();  ///< From a to b, unit; zero if they are the same.

  OrientedPair() noexcept = default;
  /// @param in_normal_a,in_normal_b Unit.
  OrientedPair(const Vec3& in_a_m, const Vec3& in_normal_a, const Vec3& in_b_m,
               const Vec3& in_normal_b) noexcept
      : a_m(in_a_m),
        normal_a(in_normal_a),
        b_m(in_b_m),
        normal_b(in_normal_b),
        distance_m((b_m - a_m).norm()),
        line(distance_m > 0.0F ? Vec3((b_m - a_m) / distance_m) : Vec3::Zero()) {}

  [[nodiscard]] bool IsAsFar(float squared_m2, float tolerance_m) const noexcept {
    const float least_m = distance_m > tolerance_m ? distance_m - tolerance_m : 0.0F;
    const float most_m = distance_m + tolerance_m;
    return squared_m2 >= least_m * least_m && squared_m2 <= most_m * most_m;
  }

  /// Whether the cosines between both normals and the line, and that of one normal to the other,
  /// are those of another pair.
  [[nodiscard]] bool IsLike(const OrientedPair& other, float cosine_tolerance) const noexcept;

  /// The pose that takes this pair, camera frame, onto one in the object frame: their middles and
  /// lines onto each other, and the normals as far as those leave it open.
  [[nodiscard]] PoseObjectFromCamera LaidOnto(const OrientedPair& known_o) const noexcept;
};

}  // namespace disflow
