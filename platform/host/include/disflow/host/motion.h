// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "disflow/host/rigid_state.h"
#include "disflow/host/simulation_options.h"

namespace disflow::host {

/// Box in front of the camera in which an object's origin may move, camera axes at the start.
struct Workspace {
  Vec3d centre_m = Vec3d(0.0, 0.0, 0.7);
  Vec3d half_extent_m = Vec3d::Zero();
};

/// The largest box at 0.55 m or more in which a sphere of that radius stays inside of the image.
/// @param distance_m The box is no nearer than this.
[[nodiscard]] Workspace FitWorkspace(const PinholeCamera& camera, int width_px, int height_px,
                                     double radius_m, double distance_m = 0.0);

/// The same for several objects, one behind the other: their spheres never touch, and the nearer
/// ones pass in front of the farther ones.
[[nodiscard]] std::vector<Workspace> StackWorkspaces(const PinholeCamera& camera, int width_px,
                                                     int height_px, std::span<const double> radii_m,
                                                     double distance_m = 0.0);

/// An object's motion in the world; a pure function of time.
class ObjectMotion {
 public:
  virtual ~ObjectMotion() = default;
  /// @param time_s Since the first frame, >= 0.
  [[nodiscard]] virtual RigidState<World, Object> At(double time_s) const = 0;
};

struct MotionSettings {
  MotionKind kind = MotionKind::kModerate;
  Workspace workspace;
  Mat3d start_rotation = Mat3d::Identity();  ///< Object in the world.
  double duration_s = 10.0;
  double frame_period_s = 1.0 / 30.0;
  std::uint64_t seed = 1;
};

[[nodiscard]] std::unique_ptr<const ObjectMotion> MakeObjectMotion(const MotionSettings& settings);

}  // namespace disflow::host
