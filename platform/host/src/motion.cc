// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/motion.h"

#include <algorithm>
#include <cmath>

#include "flying_motion.h"
#include "leaving_motion.h"
#include "smooth_motion.h"
#include "turn_motion.h"

namespace disflow::host {
namespace {

constexpr double kMaxReach_m = 0.20;
constexpr double kNearest_m = 0.55;

/// Tangents of half the angles that an object may use.
struct ViewCone {
  ViewCone(const PinholeCamera& camera, int width_px, int height_px)
      : x(Tangent(camera.cx_px, width_px, camera.fx_px)),
        y(Tangent(camera.cy_px, height_px, camera.fy_px)) {}
  double x;
  double y;

  /// The nearest that the centre of a sphere may come and still move a little.
  [[nodiscard]] double Nearest(double radius_m) const {
    constexpr double kMinReach_m = 0.03;
    const double narrow = std::min(x, y);
    return std::max(kNearest_m, (kMinReach_m + radius_m * std::hypot(1.0, narrow)) / narrow);
  }

 private:
  static double Tangent(float centre_px, int size_px, float focal_px) {
    constexpr double kBorder_px = 4.0;
    const auto centre = static_cast<double>(centre_px);
    const double half_px = std::min(centre, size_px - 1 - centre) - kBorder_px;
    return std::max(half_px, 1.0) / static_cast<double>(focal_px);
  }
};

/// Distance from the optical axis, on one side, that a sphere of a radius may reach.
double Reach(double tangent, double depth_m, double radius_m) {
  return depth_m * tangent - radius_m * std::hypot(1.0, tangent);
}

/// Centres of a sphere from `nearest_m` on, no farther from the axis than `reach_m`.
Workspace MakeWorkspace(const ViewCone& view, double nearest_m, double depth_range_m,
                        double radius_m, double reach_m) {
  Workspace workspace;
  workspace.centre_m = Vec3d(0.0, 0.0, nearest_m + 0.5 * depth_range_m);
  workspace.half_extent_m =
      Vec3d(std::min(reach_m, Reach(view.x, nearest_m, radius_m)),
            std::min(reach_m, Reach(view.y, nearest_m, radius_m)), 0.5 * depth_range_m);
  return workspace;
}

}  // namespace

Workspace FitWorkspace(const PinholeCamera& camera, int width_px, int height_px, double radius_m,
                       double distance_m) {
  constexpr double kDepthRange_m = 0.24;
  const ViewCone view(camera, width_px, height_px);
  const double nearest_m = std::max(view.Nearest(radius_m), distance_m);
  return MakeWorkspace(view, nearest_m, kDepthRange_m, radius_m, kMaxReach_m);
}

std::vector<Workspace> StackWorkspaces(const PinholeCamera& camera, int width_px, int height_px,
                                       std::span<const double> radii_m, double distance_m) {
  constexpr double kDepthRange_m = 0.06;
  constexpr double kGap_m = 0.01;
  const ViewCone view(camera, width_px, height_px);
  // Homes beside each other and ways that overlap: they pass one another and do not stay hidden.
  constexpr double kHomes = 0.8;
  constexpr double kWays = 1.6;
  const std::size_t count = radii_m.size();
  std::vector<Workspace> workspaces;
  double free_from_m = distance_m - radii_m.front();
  for (std::size_t i = 0; i < count; ++i) {
    const double radius_m = radii_m[i];
    const double nearest_m = std::max(view.Nearest(radius_m), free_from_m + radius_m);
    const double reach_m = Reach(view.x, nearest_m, radius_m);
    // Neighbours in depth are no neighbours sideways.
    const std::size_t place = (2 * i + 1) % (count + (count + 1) % 2);
    const double home =
        kHomes * ((2.0 * static_cast<double>(place) + 1.0) / static_cast<double>(count) - 1.0);
    const double way = std::min(1.0 - std::abs(home), kWays / static_cast<double>(count));
    Workspace workspace = MakeWorkspace(view, nearest_m, kDepthRange_m, radius_m, kMaxReach_m);
    workspace.centre_m.x() = home * reach_m;
    workspace.half_extent_m.x() = way * reach_m;
    workspaces.push_back(workspace);
    free_from_m = nearest_m + kDepthRange_m + radius_m + kGap_m;
  }
  return workspaces;
}

std::unique_ptr<const ObjectMotion> MakeObjectMotion(const MotionSettings& settings) {
  switch (settings.kind) {
    case MotionKind::kStatic:
      return std::make_unique<SmoothMotion>(settings, MotionPeaks{0.0, 0.0});
    case MotionKind::kModerate:
      return std::make_unique<SmoothMotion>(settings, MotionPeaks{0.2, 90.0 * kRadPerDeg});
    case MotionKind::kFast:
      return std::make_unique<SmoothMotion>(settings, MotionPeaks{0.6, 270.0 * kRadPerDeg});
    case MotionKind::kRotate360:
      return std::make_unique<TurnMotion>(settings);
    case MotionKind::kLeaving:
      return std::make_unique<LeavingMotion>(settings);
    case MotionKind::kFlying:
      return std::make_unique<FlyingMotion>(settings, MotionPeaks{1.2, 500.0 * kRadPerDeg});
  }
  return nullptr;
}

}  // namespace disflow::host
