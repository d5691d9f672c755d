// SPDX-License-Identifier: BSD-3-Clause
// The smallest program that uses the library: depth images in memory in, pose and speed out.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "disflow/field/distance_query.h"
#include "disflow/tracker.h"
#include "moving_corner.h"

using consumer::kHeight;
using consumer::kWidth;

int main() {
  static disflow::Tracker<disflow::profiles::Edge>
      tracker;  // all memory that will ever be used, in .bss
  std::vector<std::uint16_t> depth_mm(kWidth * kHeight);
  disflow::DepthFrame frame;
  frame.depth = {depth_mm.data(), kWidth, kHeight, kWidth * 2, disflow::DepthFormat::kUint16,
                 0.001F};
  frame.camera = consumer::kCamera;
  disflow::Estimate estimate;
  for (int i = 0; i < 30; ++i) {
    consumer::TakeImage(i / 30.0, frame.camera, depth_mm);
    frame.stamp_ns = 1 + i * 33'333'333LL;
    if (tracker.Process(frame, estimate) != disflow::Status::kOk) {
      std::fprintf(stderr, "frame %d: %s\n", i, disflow::Describe(estimate.status));
      return 1;
    }
  }
  const disflow::Vec3& position_m = estimate.T_co.translation();
  std::printf("position %.3f %.3f %.3f m, speed %.3f m/s, %s\n",
              static_cast<double>(position_m.x()), static_cast<double>(position_m.y()),
              static_cast<double>(position_m.z()),
              static_cast<double>(estimate.twist.linear_mps.norm()), disflow::Name(estimate.state));

  // How far a point is from the surface, e.g. a finger of a gripper; object frame.
  using Querier = disflow::DistanceQuerier<disflow::profiles::Edge>;
  static Querier::Workspace workspace;
  Querier querier(tracker.field(), workspace, 0.01F);
  const auto finger = querier.Query({0.0F, 0.0F, -0.3F});
  if (!finger.ok()) return 1;
  std::printf("a finger there is %.3f m away, +- %.3f m\n",
              static_cast<double>(finger.value.distance_m),
              static_cast<double>(std::sqrt(finger.value.variance_m2)));
  const float speed_mps = estimate.twist.linear_mps.x();
  const bool is_plausible = finger.value.distance_m > 0.1F && finger.value.distance_m < 0.3F;
  return is_plausible && speed_mps > 0.08F && speed_mps < 0.12F ? 0 : 1;
}
