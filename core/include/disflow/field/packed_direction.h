// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "disflow/field/fast_math.h"
#include "disflow/memory/fixed_point.h"
#include "disflow/types.h"

namespace disflow {

/// A unit vector in four bytes: its projection onto the octahedron |x| + |y| + |z| = 1, unfolded
/// into a square (Meyer et al. 2010). Off by less than 7e-5 rad. Zero and NaN become some
/// direction.
class PackedDirection {
 public:
  PackedDirection() = default;
  explicit PackedDirection(const Vec3& direction) noexcept {
    const float sum = direction.cwiseAbs().sum();
    const float inverse = sum > 0.0F ? 1.0F / sum : 0.0F;
    const float x = direction.x() * inverse;
    const float y = direction.y() * inverse;
    const bool below = direction.z() < 0.0F;
    steps_[0] = RoundToSteps(kMostSteps * (below ? Fold(x, y) : x));
    steps_[1] = RoundToSteps(kMostSteps * (below ? Fold(y, x) : y));
  }

  /// Of unit length but for 3e-7.
  [[nodiscard]] Vec3 direction() const noexcept {
    const float x = static_cast<float>(steps_[0]) / kMostSteps;
    const float y = static_cast<float>(steps_[1]) / kMostSteps;
    const float z = 1.0F - std::abs(x) - std::abs(y);
    const Vec3 unfolded(z < 0.0F ? Fold(x, y) : x, z < 0.0F ? Fold(y, x) : y, z);
    return unfolded * FastInverseSqrt(unfolded.squaredNorm());
  }

 private:
  /// Mirrors the lower half's triangles into the corners of the square, and back.
  [[nodiscard]] static float Fold(float a, float b) noexcept {
    return std::copysign(1.0F - std::abs(b), a);
  }

  std::array<std::int16_t, 2> steps_;
};

}  // namespace disflow
