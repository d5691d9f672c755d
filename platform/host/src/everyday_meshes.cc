// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "disflow/host/object_meshes.h"
#include "mesh_tube.h"

namespace disflow::host {
namespace {

using std::numbers::pi;

constexpr int kArcSteps = 16;  // of a quarter turn, or of a rim's half

/// Width at which a superellipse of an exponent crosses the direction of an angle.
double SuperellipseRadius(double angle, double half_x_m, double half_y_m, double exponent) {
  return std::pow(std::pow(std::abs(std::cos(angle)) / half_x_m, exponent) +
                      std::pow(std::abs(std::sin(angle)) / half_y_m, exponent),
                  -1.0 / exponent);
}

/// A section of a body about the z axis.
struct Section {
  double z_m;
  double half_x_m;
  double half_y_m;
  double exponent;  // 2: an ellipse, more: a box with rounded corners
};

/// A body of sections one above the other, closed by flat ends.
TriangleMesh MeshSections(const std::vector<Section>& sections, int columns) {
  const int rows = static_cast<int>(sections.size()) + 2;
  return MeshTube(columns, rows, false, [&](double angle, int row) {
    const Section& section = sections[static_cast<std::size_t>(std::clamp(row - 1, 0, rows - 3))];
    if (row == 0 || row == rows - 1) return Vec3d(0.0, 0.0, section.z_m);
    const double radius_m =
        SuperellipseRadius(angle, section.half_x_m, section.half_y_m, section.exponent);
    return Vec3d(radius_m * std::cos(angle), radius_m * std::sin(angle), section.z_m);
  });
}

/// Smooth step from 0 at `low` to 1 at `high`.
double Step(double x, double low, double high) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// A corner of an outline: the middle of the arc that rounds it.
struct Corner {
  double x_m;
  double y_m;
  double from_rad;  ///< Direction of the outline's normal where the arc begins.
};

/// What is cut out of a sheet along an outline whose corners are rounded, with rounded edges.
/// @param corner_m Radius about a corner's middle; about the one that bends inwards it is the
/// fillet's.
/// @param inner_corner Which one that is: it turns the other way.
TriangleMesh MeshSheet(std::span<const Corner> corners, double corner_m, double fillet_m,
                       std::size_t inner_corner, const Vec3d& middle_m, double half_width_m,
                       double edge_m) {
  constexpr int kPerCorner = kArcSteps + 1;
  constexpr int kPerEdge = 8 + 1;
  constexpr int kRows = 2 * kPerEdge + 2;
  const int columns = kPerCorner * static_cast<int>(corners.size());
  return MeshTube(columns, kRows, false, [&](double angle, int row) {
    const bool below = row <= kPerEdge;
    const double side = below ? -1.0 : 1.0;
    if (row == 0 || row == kRows - 1) return Vec3d(middle_m.x(), middle_m.y(), side * half_width_m);
    const int step = below ? row - 1 : kRows - 2 - row;
    const double up_rad = 0.5 * pi * step / (kPerEdge - 1);  // 0: on the flat side
    const int column = static_cast<int>(std::lround(angle / (2.0 * pi) * columns));
    const auto which = static_cast<std::size_t>(column / kPerCorner);
    const Corner& corner = corners[which];
    const bool inner = which == inner_corner;
    const double turned = 0.5 * pi * (column % kPerCorner) / kArcSteps;
    const double normal_rad = corner.from_rad + (inner ? -turned : turned);
    const double inset_m = edge_m * (1.0 - std::sin(up_rad));
    const double radius_m = inner ? -(fillet_m + inset_m) : corner_m - inset_m;
    return Vec3d(corner.x_m + radius_m * std::cos(normal_rad),
                 corner.y_m + radius_m * std::sin(normal_rad),
                 side * (half_width_m - edge_m * (1.0 - std::cos(up_rad))));
  });
}

}  // namespace

TriangleMesh MakeBowl() {
  constexpr double kOuter_m = 0.075;
  constexpr double kWall_m = 0.003;
  constexpr double kFoot_m = 0.028;
  constexpr double kInner_m = kOuter_m - kWall_m;
  const double foot_rad = -std::acos(kFoot_m / kOuter_m);
  constexpr double kRim_rad = -0.15;
  std::vector<ProfilePoint> profile{{0.0, kOuter_m * std::sin(foot_rad)}};
  AppendArc(profile, {0.0, 0.0}, kOuter_m, foot_rad, kRim_rad, 4 * kArcSteps);
  const double middle_m = kOuter_m - 0.5 * kWall_m;
  AppendArc(profile, {middle_m * std::cos(kRim_rad), middle_m * std::sin(kRim_rad)}, 0.5 * kWall_m,
            kRim_rad, kRim_rad + pi, kArcSteps);
  // The floor is a little thicker than the wall.
  const double floor_m = kOuter_m * std::sin(foot_rad) + kWall_m;
  AppendArc(profile, {0.0, 0.0}, kInner_m, kRim_rad, std::asin(floor_m / kInner_m), 4 * kArcSteps);
  profile.push_back({0.0, floor_m});
  TriangleMesh mesh = MeshProfile(profile, 200);
  MoveCentreToOrigin(mesh);
  return mesh;
}

TriangleMesh MakeTube() {
  constexpr double kRadius_m = 0.027;
  constexpr double kHalfLength_m = 0.080;
  constexpr double kRim_m = 0.0015;
  std::vector<ProfilePoint> profile;
  const double middle_m = kRadius_m - kRim_m;
  AppendArc(profile, {middle_m, kHalfLength_m - kRim_m}, kRim_m, 0.0, pi, kArcSteps);
  AppendArc(profile, {middle_m, kRim_m - kHalfLength_m}, kRim_m, pi, 2.0 * pi, kArcSteps);
  return MeshProfile(profile, 120, true);
}

TriangleMesh MakeSuperellipsoid() {
  constexpr double kUpright = 3.5;
  constexpr double kAround = 3.0;
  const Vec3d half_m(0.050, 0.035, 0.070);
  constexpr int kRows = 161;
  return MeshTube(240, kRows, false, [&](double angle, int row) {
    if (row == 0) return Vec3d(0.0, 0.0, -half_m.z());
    if (row == kRows - 1) return Vec3d(0.0, 0.0, half_m.z());
    const double up_rad = pi * (static_cast<double>(row) / (kRows - 1) - 0.5);
    const double around_m = SuperellipseRadius(angle, half_m.x(), half_m.y(), kAround);
    // The profile above this direction is a superellipse once more.
    const double radius_m = SuperellipseRadius(up_rad, around_m, half_m.z(), kUpright);
    const double across_m = radius_m * std::cos(up_rad);
    return Vec3d(across_m * std::cos(angle), across_m * std::sin(angle),
                 radius_m * std::sin(up_rad));
  });
}

TriangleMesh MakeScrewdriver() {
  constexpr double kHandle_m = 0.105;
  constexpr double kShaftRadius_m = 0.0035;
  constexpr double kTip_m = 0.215;
  std::vector<double> heights;
  for (int i = 0; i <= 140; ++i) heights.push_back(kHandle_m * i / 140);
  for (int i = 1; i <= 30; ++i) heights.push_back(kHandle_m + (kTip_m - kHandle_m) * i / 30);
  const int rows = static_cast<int>(heights.size()) + 2;
  TriangleMesh mesh = MeshTube(96, rows, false, [&](double angle, int row) {
    const double z = heights[static_cast<std::size_t>(std::clamp(row - 1, 0, rows - 3))];
    if (row == 0 || row == rows - 1) return Vec3d(0.0, 0.0, z);
    // The handle: a round back, a waist for the fingers, six flutes.
    const double back_m = 0.016 * std::sqrt(std::max(0.0, 1.0 - std::pow(1.0 - z / 0.016, 2)));
    const double waist_m = 0.016 - 0.004 * Step(z, 0.060, 0.085) + 0.0025 * Step(z, 0.085, 0.098);
    const double flutes_m = 0.0012 * Step(z, 0.008, 0.02) * (1.0 - Step(z, 0.055, 0.075));
    double handle_m = z < 0.016 ? std::min(back_m, waist_m) : waist_m;
    handle_m -= flutes_m * (0.5 - 0.5 * std::cos(6.0 * angle));
    const double shaft = Step(z, kHandle_m - 0.006, kHandle_m);
    const double radius_m = handle_m * (1.0 - shaft) + kShaftRadius_m * shaft;
    // The blade is flat and a little wider.
    const double blade = Step(z, kTip_m - 0.018, kTip_m);
    return Vec3d(radius_m * (1.0 + 0.15 * blade) * std::cos(angle),
                 radius_m * (1.0 - 0.85 * blade) * std::sin(angle), z);
  });
  MoveCentreToOrigin(mesh);
  return mesh;
}

TriangleMesh MakeBracket() {
  constexpr double kLong_m = 0.090;
  constexpr double kShort_m = 0.065;
  constexpr double kSheet_m = 0.006;
  constexpr double kHalfWidth_m = 0.020;
  constexpr double kCorner_m = 0.002;
  constexpr double kFillet_m = 0.004;
  constexpr double kEdge_m = 0.001;
  // Around the L, the corner of its legs at the origin.
  constexpr std::array<Corner, 6> kCorners{{{kCorner_m, kCorner_m, -pi},
                                            {kLong_m - kCorner_m, kCorner_m, -0.5 * pi},
                                            {kLong_m - kCorner_m, kSheet_m - kCorner_m, 0.0},
                                            {kSheet_m + kFillet_m, kSheet_m + kFillet_m, 0.5 * pi},
                                            {kSheet_m - kCorner_m, kShort_m - kCorner_m, 0.0},
                                            {kCorner_m, kShort_m - kCorner_m, 0.5 * pi}}};
  const Vec3d middle(0.5 * kSheet_m, 0.5 * kSheet_m, 0.0);
  TriangleMesh mesh = MeshSheet(kCorners, kCorner_m, kFillet_m, 3, middle, kHalfWidth_m, kEdge_m);
  MoveCentreToOrigin(mesh);
  return mesh;
}

TriangleMesh MakeSprayBottle() {
  constexpr double kShoulder_m = 0.120;
  constexpr double kNeck_m = 0.165;
  std::vector<Section> sections;
  for (int i = 0; i <= 12; ++i) {  // the foot is rounded
    const double angle = 0.5 * pi * i / 12;
    const double in_m = 0.006 * (1.0 - std::sin(angle));
    sections.push_back({0.006 * (1.0 - std::cos(angle)), 0.046 - in_m, 0.029 - in_m, 3.0});
  }
  for (int i = 1; i <= 90; ++i) {
    const double z = 0.006 + (kNeck_m - 0.006) * i / 90;
    const double neck = Step(z, kShoulder_m - 0.02, kNeck_m);
    sections.push_back(
        {z, 0.046 * (1.0 - neck) + 0.013 * neck, 0.029 * (1.0 - neck) + 0.013 * neck, 3.0 - neck});
  }
  TriangleMesh mesh = MeshSections(sections, 160);
  // Collar, head and nozzle reach into each other, the trigger into the head.
  Append(MeshSections({{-0.009, 0.017, 0.017, 2.0}, {0.009, 0.016, 0.016, 2.0}}, 96),
         Vec3d(0.0, 0.0, kNeck_m), mesh);
  Append(MakeRoundedCuboid(0.5 * Vec3d(0.075, 0.026, 0.032), 0.006),
         Vec3d(0.012, 0.0, kNeck_m + 0.022), mesh);
  Append(MakeRoundedCuboid(0.5 * Vec3d(0.020, 0.014, 0.014), 0.003),
         Vec3d(0.056, 0.0, kNeck_m + 0.028), mesh);
  Append(MakeRoundedCuboid(0.5 * Vec3d(0.009, 0.016, 0.048), 0.003),
         Vec3d(0.036, 0.0, kNeck_m - 0.008), mesh);
  MoveCentreToOrigin(mesh);
  return mesh;
}

}  // namespace disflow::host
