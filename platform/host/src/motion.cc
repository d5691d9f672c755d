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

/// Distance from the optical axis, on one side, that a sphere of a radius may reach.
double Reach(double tangent, double depth_m, double radius_m) {
  return depth_m * tangent - radius_m * std::hypot(1.0, tangent);
}

}  // namespace

Workspace FitWorkspace(const PinholeCamera& camera, int width_px, int height_px, double radius_m) {
  constexpr double kBorder_px = 4.0;
  constexpr double kNearest_m = 0.55;
  constexpr double kDepthRange_m = 0.24;
  constexpr double kMinReach_m = 0.03;
  constexpr double kMaxReach_m = 0.20;
  const auto tangent = [](double centre_px, int size_px, double focal_px) {
    const double half_px = std::min(centre_px, size_px - 1 - centre_px) - kBorder_px;
    return std::max(half_px, 1.0) / focal_px;
  };
  const double tan_x =
      tangent(static_cast<double>(camera.cx_px), width_px, static_cast<double>(camera.fx_px));
  const double tan_y =
      tangent(static_cast<double>(camera.cy_px), height_px, static_cast<double>(camera.fy_px));
  const double narrow = std::min(tan_x, tan_y);
  const double nearest_m =
      std::max(kNearest_m, (kMinReach_m + radius_m * std::hypot(1.0, narrow)) / narrow);
  Workspace workspace;
  workspace.centre_m = Vec3d(0.0, 0.0, nearest_m + 0.5 * kDepthRange_m);
  workspace.half_extent_m =
      Vec3d(std::min(kMaxReach_m, Reach(tan_x, nearest_m, radius_m)),
            std::min(kMaxReach_m, Reach(tan_y, nearest_m, radius_m)), 0.5 * kDepthRange_m);
  return workspace;
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
