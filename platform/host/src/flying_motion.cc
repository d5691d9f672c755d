// SPDX-License-Identifier: BSD-3-Clause
#include "flying_motion.h"

#include <algorithm>
#include <cmath>

namespace disflow::host {
namespace {

Vec3d RandomInBox(RandomNumbers& random) {
  Vec3d x;
  for (int i = 0; i < 3; ++i) x[i] = random.Uniform(-1.0, 1.0);
  return x;
}

RigidState<World, Object> Advance(const RigidState<World, Object>& start, double duration_s) {
  RigidState<World, Object> state = start;
  const Mat3d turn = ExpSo3(Vec3d(start.angular_rps * duration_s));
  state.pose = {Mat3d(turn * start.pose.rotation()),
                Vec3d(start.pose.translation() + start.linear_mps * duration_s)};
  return state;
}

}  // namespace

FlyingMotion::FlyingMotion(const MotionSettings& settings, const MotionPeaks& peaks) {
  RandomNumbers random(settings.seed, 3);
  const Workspace& space = settings.workspace;
  const double frame_s = settings.frame_period_s;
  // At rest first, so that a tracker can start.
  Flight flight{0.0, {}};
  flight.at_start.pose = {settings.start_rotation, space.centre_m};
  flights_.push_back(flight);
  double next_s = (std::floor(0.2 / frame_s) + 0.5) * frame_s;
  while (next_s < settings.duration_s) {
    flight.at_start = Advance(flights_.back().at_start, next_s - flights_.back().start_s);
    flight.start_s = next_s;
    const Vec3d target = space.centre_m + space.half_extent_m.cwiseProduct(RandomInBox(random));
    const Vec3d way = target - flight.at_start.pose.translation();
    const double speed_mps = peaks.linear_mps * random.Uniform(0.5, 1.0);
    // Whole frames, at least two; rounding up only makes the flight slower.
    const double frames = std::max(2.0, std::ceil(way.norm() / speed_mps / frame_s));
    flight.at_start.linear_mps = way / (frames * frame_s);
    const Vec3d axis = RandomInBox(random).normalized();
    flight.at_start.angular_rps = axis * (peaks.angular_rps * random.Uniform(0.4, 1.0));
    flights_.push_back(flight);
    next_s += frames * frame_s;
  }
}

RigidState<World, Object> FlyingMotion::At(double time_s) const {
  const auto later =
      std::upper_bound(flights_.begin() + 1, flights_.end(), time_s,
                       [](double time, const Flight& flight) { return time < flight.start_s; });
  const Flight& flight = *(later - 1);
  return Advance(flight.at_start, time_s - flight.start_s);
}

}  // namespace disflow::host
