// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "disflow/field/gp_workspace.h"

/// @file
/// What one cluster of the tracker holds: a handful of samples on a small piece of surface.

namespace disflow::testing {

inline constexpr GpHyperparameters kHyper{0.06F, 0.25F};
inline constexpr int kSamples = 16;
using Gp = LocalGp<kSamples>;
using Workspace = GpWorkspace<kSamples>;
using Samples = std::vector<GpTrainingSample>;

inline constexpr float kValueVariance_m2 = 9e-8F;  // 0.3 mm
inline constexpr float kNormalVariance = 0.01F;

/// A piece of surface with the plane that the cluster takes for it.
struct Patch {
  Samples samples;
  Vec3 center_m;
  Vec3 normal;

  [[nodiscard]] bool TrainInto(Workspace& workspace, Gp& gp,
                               const GpHyperparameters& hyper = kHyper) const {
    return workspace.Train(samples, center_m, normal, hyper, gp);
  }
};

struct Prediction {
  float distance_m;
  Vec3 gradient;
};

inline Prediction Predict(const Gp& gp, const Vec3& x_m) {
  Prediction mean;
  gp.Mean(x_m, mean.distance_m, mean.gradient);
  return mean;
}

/// The `i`-th of `count` points spread evenly over a disc.
inline Vec2 DiscPoint(int i, int count, float radius_m) {
  constexpr float kGoldenAngle_rad = 2.3999632F;
  const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
  const float phi = kGoldenAngle_rad * static_cast<float>(i);
  return radius_m * std::sqrt(share) * Vec2(std::cos(phi), std::sin(phi));
}

/// Samples around the pole of a sphere whose centre is the origin.
inline Patch SpherePatch(float sphere_radius_m, float patch_radius_m, int count = kSamples) {
  Patch patch{{}, Vec3::Zero(), Vec3::UnitZ()};
  for (int i = 0; i < count; ++i) {
    const Vec2 xy = DiscPoint(i, count, patch_radius_m);
    const Vec3 x(xy.x(), xy.y(), std::sqrt(sphere_radius_m * sphere_radius_m - xy.squaredNorm()));
    patch.samples.push_back({x, x / sphere_radius_m, kValueVariance_m2, kNormalVariance});
    patch.center_m += x / static_cast<float>(count);
  }
  return patch;
}

/// Samples on a bumpy, noisy, tilted surface anywhere in space: nothing is special about it.
inline Patch RandomPatch(unsigned seed, int count = kSamples) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(-1.0F, 1.0F);
  const auto vector = [&] {
    const float x = uniform(random);
    const float y = uniform(random);
    return Vec3(x, y, uniform(random));
  };
  const Vec3 origin_m = 0.3F * vector();
  const Vec3 normal = vector().normalized();
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  Patch patch{{}, Vec3::Zero(), (normal + 0.1F * vector()).normalized()};
  for (int i = 0; i < count; ++i) {
    const Vec2 xy = DiscPoint(i, count, 0.018F);
    const Vec3 x = origin_m + xy.x() * u + xy.y() * v + 0.002F * uniform(random) * normal;
    patch.samples.push_back({x, (normal + 0.3F * vector()).normalized(),
                             kValueVariance_m2 * (2.0F + uniform(random)),
                             kNormalVariance * (2.0F + uniform(random))});
    patch.center_m += x / static_cast<float>(count);
  }
  return patch;
}

/// Points on and around a patch, up to far away.
inline std::vector<Vec3> QueryPoints(const Patch& patch) {
  std::mt19937 random(99);
  std::normal_distribution<float> normal;
  std::vector<Vec3> points{patch.center_m, patch.samples.front().position_m};
  for (const float spread_m : {0.002F, 0.01F, 0.03F, 0.1F, 1.0F}) {
    for (int i = 0; i < 6; ++i) {
      const float x = normal(random);
      const float y = normal(random);
      points.push_back(patch.center_m + spread_m * Vec3(x, y, normal(random)));
    }
  }
  return points;
}

}  // namespace disflow::testing
