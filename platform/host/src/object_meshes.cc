// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/object_meshes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "mesh_tube.h"

namespace disflow::host {
namespace {

using std::numbers::pi;

/// Smooth step from 0 at `low` to 1 at `high` with continuous curvature.
double Blend(double x, double low, double high) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

// Heights of the bottle's parts above its foot.
constexpr double kBottleFoot_m = 0.008;
constexpr double kBottleShoulder_m = 0.112;
constexpr double kBottleNeck_m = 0.148;
constexpr double kBottleCap_m = 0.163;
constexpr double kBottleTop_m = 0.191;

/// Half widths of the bottle's body between foot and neck, slightly waisted.
Vec3d BottleSection(double z_m) {
  const double waist = 1.0 - 0.05 * std::pow(std::sin(pi * std::min(z_m / 0.13, 1.0)), 2);
  const double neck = Blend(z_m, kBottleShoulder_m - 0.03, kBottleNeck_m);
  constexpr double kNeckRadius_m = 0.0165;
  return {waist * 0.0475 * (1.0 - neck) + kNeckRadius_m * neck,
          waist * 0.0260 * (1.0 - neck) + kNeckRadius_m * neck,
          waist * 0.0320 * (1.0 - neck) + kNeckRadius_m * neck};
}

}  // namespace

TriangleMesh MakeCrackerBox() {
  constexpr double kX_m = 0.5 * 0.164;
  constexpr double kY_m = 0.5 * 0.072;
  constexpr double kZ_m = 0.5 * 0.213;
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    mesh.vertices.emplace_back((corner & 1) != 0 ? kX_m : -kX_m, (corner & 2) != 0 ? kY_m : -kY_m,
                               (corner & 4) != 0 ? kZ_m : -kZ_m);
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh MakeMustardBottle() {
  struct Ring {
    double scale;  // of the section; 0 = its centre
    double z_m;
  };
  std::vector<Ring> rings{{0.0, 0.0}};
  constexpr int kFootSteps = 12;
  for (int i = 0; i <= kFootSteps; ++i) {
    const double angle = 0.5 * pi * (static_cast<double>(i) / kFootSteps - 1.0);
    rings.push_back(
        {1.0 - 0.15 * (1.0 - std::cos(angle)), kBottleFoot_m * (1.0 + std::sin(angle))});
  }
  constexpr int kBodySteps = 90;
  for (int i = 1; i <= kBodySteps; ++i) {
    rings.push_back({1.0, kBottleFoot_m + (kBottleCap_m - kBottleFoot_m) * i / kBodySteps});
  }
  // Cap: narrower by a step, then the nozzle's cone with a rounded tip.
  rings.push_back({0.86, kBottleCap_m});
  rings.push_back({0.86, kBottleCap_m + 0.006});
  rings.push_back({0.42, kBottleCap_m + 0.009});
  rings.push_back({0.22, kBottleTop_m - 0.002});
  rings.push_back({0.14, kBottleTop_m});
  rings.push_back({0.0, kBottleTop_m});
  TriangleMesh mesh =
      MeshTube(144, static_cast<int>(rings.size()), false, [&rings](double angle, int row) {
        const Ring& ring = rings[static_cast<std::size_t>(row)];
        const Vec3d section = BottleSection(ring.z_m);
        const double y = std::sin(angle);
        return Vec3d(ring.scale * section.x() * std::cos(angle),
                     ring.scale * y * (y > 0.0 ? section.z() : section.y()), ring.z_m);
      });
  MoveCentreToOrigin(mesh);
  return mesh;
}

TriangleMesh MakeCan() {
  constexpr double kRadius_m = 0.050;
  constexpr double kHeight_m = 0.140;
  constexpr double kRim_m = 0.001;  // radius of the rolled rim, and how far it stands out
  constexpr double kRecess_m = 0.003;
  std::vector<ProfilePoint> profile{{0.0, kRecess_m}, {kRadius_m - 2.0 * kRim_m, kRecess_m}};
  AppendArc(profile, {kRadius_m, kRim_m}, kRim_m, -pi, 0.0, 12);
  profile.push_back({kRadius_m + kRim_m, 2.5 * kRim_m});
  constexpr int kBodySteps = 120;
  for (int i = 0; i <= kBodySteps; ++i) {
    const double z = 0.0035 + (kHeight_m - 0.007) * i / kBodySteps;
    // Three beads around the middle stiffen the wall.
    const double bead = std::pow(std::sin(pi * std::clamp((z - 0.04) / 0.06, 0.0, 1.0) * 3.0), 2);
    profile.push_back({kRadius_m - 0.0006 * bead, z});
  }
  profile.push_back({kRadius_m + kRim_m, kHeight_m - 2.5 * kRim_m});
  AppendArc(profile, {kRadius_m, kHeight_m - kRim_m}, kRim_m, 0.0, pi, 12);
  profile.push_back({kRadius_m - 2.0 * kRim_m, kHeight_m - kRecess_m});
  profile.push_back({0.0, kHeight_m - kRecess_m});
  TriangleMesh mesh =
      MeshTube(240, static_cast<int>(profile.size()), false, [&profile](double angle, int row) {
        const ProfilePoint& point = profile[static_cast<std::size_t>(row)];
        const double along_wall_m = kRadius_m * std::remainder(angle, 2.0 * pi);
        const bool on_wall =
            point.z_m > 0.003 && point.z_m < kHeight_m - 0.003 && point.radius_m > 0.9 * kRadius_m;
        const double seam =
            on_wall ? 0.0006 * std::exp(-0.5 * std::pow(along_wall_m / 0.002, 2)) : 0.0;
        const double radius = point.radius_m + seam;
        return Vec3d(radius * std::cos(angle), radius * std::sin(angle), point.z_m);
      });
  MoveCentreToOrigin(mesh);
  return mesh;
}

TriangleMesh MakeDoughnut() {
  constexpr double kRing_m = 0.040;
  constexpr double kTube_m = 0.020;
  constexpr int kRows = 96;
  return MeshTube(160, kRows, true, [](double angle, int row) {
    const double tube_angle = 2.0 * pi * row / kRows;
    const double radius = kRing_m + kTube_m * std::cos(tube_angle);
    return Vec3d(radius * std::cos(angle), radius * std::sin(angle),
                 kTube_m * std::sin(tube_angle));
  });
}

TriangleMesh MakeCapsule(double radius_m, double length_m) {
  std::vector<ProfilePoint> profile;
  AppendArc(profile, {0.0, radius_m - length_m}, radius_m, -0.5 * pi, 0.0, 16);
  AppendArc(profile, {0.0, -radius_m}, radius_m, 0.0, 0.5 * pi, 16);
  profile.front().radius_m = 0.0;
  profile.back().radius_m = 0.0;
  return MeshProfile(profile, 64);
}

}  // namespace disflow::host
