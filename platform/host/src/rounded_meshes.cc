// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <numbers>

#include "disflow/host/object_meshes.h"
#include "mesh_tube.h"

namespace disflow::host {
namespace {

using std::numbers::pi;

constexpr int kFacetsPerQuarter = 8;

/// Cosine and sine of the k-th of kFacetsPerQuarter steps from 0 to 90 degrees; exact at both ends.
struct QuarterStep {
  double cosine;
  double sine;
  explicit QuarterStep(int k)
      : cosine(k == kFacetsPerQuarter ? 0.0 : std::cos(0.5 * pi * k / kFacetsPerQuarter)),
        sine(k == 0 ? 0.0 : std::sin(0.5 * pi * k / kFacetsPerQuarter)) {}
};

/// A handle: an elliptic tube along half an ellipse in the plane y = 0, with flat ends.
TriangleMesh MakeHandle(double start_m, double reach_m, double half_height_m) {
  constexpr double kHalfWidth_m = 0.006;
  constexpr double kHalfThickness_m = 0.0035;
  constexpr int kSteps = 48;
  constexpr int kRows = kSteps + 3;
  return MeshTube(48, kRows, false, [&](double angle, int row) {
    const int step = std::min(std::max(row - 1, 0), kSteps);
    const double t = pi * step / kSteps;
    Vec3d centre(start_m + reach_m * std::sin(t), 0.0, -half_height_m * std::cos(t));
    if (row == 0 || row == kRows - 1) return centre;
    const Vec3d along = Vec3d(reach_m * std::cos(t), 0.0, half_height_m * std::sin(t)).normalized();
    const Vec3d sideways = Vec3d::UnitY();
    return Vec3d(centre + kHalfWidth_m * std::cos(angle) * sideways +
                 kHalfThickness_m * std::sin(angle) * along.cross(sideways));
  });
}

}  // namespace

// A sphere cut into eight and pulled apart: flat faces, cylinders along edges, balls at corners.
TriangleMesh MakeRoundedCuboid(const Vec3d& half_m, double radius_m) {
  constexpr int kPerQuarter = kFacetsPerQuarter + 1;
  constexpr int kColumns = 4 * kPerQuarter;
  constexpr int kRows = 2 * kPerQuarter + 2;  // and the middles of bottom and top
  const Vec3d core = half_m - Vec3d::Constant(radius_m);
  return MeshTube(kColumns, kRows, false, [&](double angle, int row) {
    if (row == 0) return Vec3d(0.0, 0.0, -half_m.z());
    if (row == kRows - 1) return Vec3d(0.0, 0.0, half_m.z());
    const int column = static_cast<int>(std::lround(angle / (2.0 * pi) * kColumns));
    const int quarter = column / kPerQuarter;
    const QuarterStep around(column % kPerQuarter);
    const bool below = row <= kPerQuarter;
    const QuarterStep up(below ? kPerQuarter - row : row - 1 - kPerQuarter);
    // Where +x turns to in the first, second, ... quarter.
    constexpr std::array<double, 4> kCos{1.0, 0.0, -1.0, 0.0};
    const double c = kCos[static_cast<std::size_t>(quarter)];
    const double s = kCos[static_cast<std::size_t>((quarter + 3) % 4)];
    const double x = c * around.cosine - s * around.sine;
    const double y = s * around.cosine + c * around.sine;
    const Vec3d corner(core.x() * (c - s), core.y() * (s + c), below ? -core.z() : core.z());
    return Vec3d(corner +
                 radius_m * Vec3d(up.cosine * x, up.cosine * y, below ? -up.sine : up.sine));
  });
}

TriangleMesh MakeRoundedBox(double edge_radius_m) {
  return MakeRoundedCuboid(0.5 * Vec3d(0.160, 0.070, 0.200), edge_radius_m);
}

TriangleMesh MakeFlatBox(double edge_radius_m) {
  return MakeRoundedCuboid(0.5 * Vec3d(0.090, 0.075, 0.030), edge_radius_m);
}

TriangleMesh MakeMug() {
  constexpr double kRadius_m = 0.042;
  constexpr double kHeight_m = 0.095;
  constexpr double kWall_m = 0.005;
  constexpr double kFoot_m = 0.004;
  constexpr double kFillet_m = 0.006;
  constexpr double kFloor_m = 0.006;
  constexpr int kArcSteps = 2 * kFacetsPerQuarter;
  std::vector<ProfilePoint> profile{{0.0, 0.0}};
  AppendArc(profile, {kRadius_m - kFoot_m, kFoot_m}, kFoot_m, -0.5 * pi, 0.0, kArcSteps);
  AppendArc(profile, {kRadius_m - 0.5 * kWall_m, kHeight_m - 0.5 * kWall_m}, 0.5 * kWall_m, 0.0, pi,
            2 * kArcSteps);
  AppendArc(profile, {kRadius_m - kWall_m - kFillet_m, kFloor_m + kFillet_m}, kFillet_m, 0.0,
            -0.5 * pi, kArcSteps);
  profile.push_back({0.0, kFloor_m});
  TriangleMesh mesh = MeshProfile(profile, 160);
  // The handle's ends are in the middle of the wall.
  const TriangleMesh handle = MakeHandle(kRadius_m - 0.5 * kWall_m, 0.031, 0.027);
  Append(handle, Vec3d(0.0, 0.0, 0.5 * kHeight_m), mesh);
  MoveCentreToOrigin(mesh);
  return mesh;
}

}  // namespace disflow::host
