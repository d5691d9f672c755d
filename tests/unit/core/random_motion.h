// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <random>

#include "disflow/geometry/transform.h"

/// @file
/// Random rigid motions in double precision, between two frames that exist for tests only.

namespace disflow::testing {

struct FrameA {};
struct FrameB {};
using MotionAB = Transform<FrameA, FrameB, double>;
using MotionBA = Transform<FrameB, FrameA, double>;
using Vec6d = Mat<double, 6>;
using Mat6d = Mat<double, 6, 6>;

class RandomMotion {
 public:
  explicit RandomMotion(unsigned seed) : random_(seed) {}

  /// (rho, theta) with |theta| = angle_rad in a random direction and rho within a metre per axis.
  [[nodiscard]] Vec6d Twist(double angle_rad) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::normal_distribution<double> normal;
    Vec6d xi;
    Mat<double, 3> axis;
    for (int i = 0; i < 3; ++i) {
      xi(i) = uniform(random_);
      axis(i) = normal(random_);
    }
    xi.tail<3>() = angle_rad * axis.normalized();
    return xi;
  }

 private:
  std::mt19937 random_;
};

}  // namespace disflow::testing
