// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "estimate_csv.h"
#include "ground_truth.h"

namespace disflow::apps {

/// A made-up motion and the rows of a tracker that follows it without error in an object frame of
/// its own. Tests then spoil the rows in a known way.
struct MadeUpRun {
  GroundTruth truth;
  EstimateTable estimates;
  ObjectFromTrue T_ot;
};

/// True velocities follow from the motion's own law, not from differences.
[[nodiscard]] inline MadeUpRun MakeRun(int frames) {
  constexpr double kPeriod_s = 1.0 / 30.0;
  const Vec3d angular_rps(0.7, -0.4, 1.1);  // constant, so R(t) = exp(t omega) R(0)
  MadeUpRun run;
  run.T_ot = ObjectFromTrue(ExpSo3(Vec3d(0.3, -0.5, 0.2)), Vec3d(0.02, 0.03, -0.04));
  const Mat3d start = ExpSo3(Vec3d(-0.2, 0.1, 0.4));
  for (int k = 0; k < frames; ++k) {
    const double t = kPeriod_s * k;
    const Vec3d position(0.1 * std::sin(2.0 * t), 0.05 * std::cos(3.0 * t), 0.6 + 0.1 * t);
    const Vec3d velocity(0.2 * std::cos(2.0 * t), -0.15 * std::sin(3.0 * t), 0.1);
    run.truth.T_ct.emplace_back(Mat3d(ExpSo3(Vec3d(t * angular_rps)) * start), position);
    run.truth.twists.push_back({velocity, angular_rps});
    run.truth.stamps_s.push_back(t);
    run.truth.file_indices.push_back(k);

    EstimateRow row;
    row.frame = k;
    row.timestamp_s = 100.0 + t;  // another clock
    row.T_co = run.truth.T_ct.back() * run.T_ot.Inverse();
    // Rigid body: the velocity of another of its points.
    row.twist = {velocity + angular_rps.cross(row.T_co.translation() - position), angular_rps};
    run.estimates.rows.push_back(row);
  }
  return run;
}

/// Corners of a cuboid as points of a model.
[[nodiscard]] inline std::vector<Vec3d> CuboidCorners() {
  std::vector<Vec3d> corners;
  for (const double x : {-0.08, 0.08}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.03, 0.03}) corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

}  // namespace disflow::apps
