// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "disflow/geometry/transform.h"
#include "disflow/types.h"

/// @file
/// Shapes whose true distance is known, and points on them as a perfect sensor would see them.

namespace disflow::testing {

struct SurfacePoint {
  Vec3 position_m;
  Vec3 normal;
};

struct Shape {
  std::function<float(const Vec3&)> distance_m;  ///< Signed, exact, outside positive.
  std::function<SurfacePoint(std::mt19937&)> random_point;
  float area_m2;

  /// Direction in which the true distance grows.
  [[nodiscard]] Vec3 Gradient(const Vec3& x_m) const {
    constexpr float kStep_m = 1e-3F;
    Vec3 gradient;
    for (int i = 0; i < 3; ++i) {
      const Vec3 step = kStep_m * Vec3::Unit(i);
      gradient(i) = (distance_m(x_m + step) - distance_m(x_m - step)) / (2.0F * kStep_m);
    }
    return gradient.normalized();
  }
};

inline float Uniform(std::mt19937& random, float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random);
}

inline Shape Sphere(float radius_m, const Vec3& center_m) {
  constexpr float kPi = std::numbers::pi_v<float>;
  return {[=](const Vec3& x_m) { return (x_m - center_m).norm() - radius_m; },
          [=](std::mt19937& random) {
            const float z = Uniform(random, -1.0F, 1.0F);
            const float azimuth = Uniform(random, -kPi, kPi);
            const float ring = std::sqrt(1.0F - z * z);
            const Vec3 normal(ring * std::cos(azimuth), ring * std::sin(azimuth), z);
            return SurfacePoint{center_m + radius_m * normal, normal};
          },
          4.0F * kPi * radius_m * radius_m};
}

/// The half-space z < 0, seen on a square.
inline Shape Plane(float half_width_m) {
  return {[](const Vec3& x_m) { return x_m.z(); },
          [=](std::mt19937& random) {
            const float x_m = Uniform(random, -half_width_m, half_width_m);
            return SurfacePoint{Vec3(x_m, Uniform(random, -half_width_m, half_width_m), 0.0F),
                                Vec3::UnitZ()};
          },
          4.0F * half_width_m * half_width_m};
}

/// @param margin_m A sensor sees no clean sample this close to an edge.
inline Shape Box(const Vec3& half_m, float margin_m) {
  const Vec3 faces_m2(half_m.y() * half_m.z(), half_m.x() * half_m.z(), half_m.x() * half_m.y());
  return {[=](const Vec3& x_m) {
            const Vec3 beyond = x_m.cwiseAbs() - half_m;
            return beyond.cwiseMax(0.0F).norm() + std::min(beyond.maxCoeff(), 0.0F);
          },
          [=](std::mt19937& random) {
            std::discrete_distribution<int> pick({static_cast<double>(faces_m2.x()),
                                                  static_cast<double>(faces_m2.y()),
                                                  static_cast<double>(faces_m2.z())});
            const int axis = pick(random);
            SurfacePoint point{Vec3::Zero(), Vec3::Zero()};
            for (int i = 0; i < 3; ++i)
              point.position_m(i) = Uniform(random, -half_m(i) + margin_m, half_m(i) - margin_m);
            point.normal(axis) = Uniform(random, -1.0F, 1.0F) < 0.0F ? -1.0F : 1.0F;
            point.position_m(axis) = point.normal(axis) * half_m(axis);
            return point;
          },
          8.0F * faces_m2.sum()};
}

/// About the z axis, with both caps.
inline Shape Cylinder(float radius_m, float half_height_m, float margin_m) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const float side_m2 = 4.0F * kPi * radius_m * half_height_m;
  const float caps_m2 = 2.0F * kPi * radius_m * radius_m;
  return {[=](const Vec3& x_m) {
            const Vec2 beyond(x_m.head<2>().norm() - radius_m, std::abs(x_m.z()) - half_height_m);
            return beyond.cwiseMax(0.0F).norm() + std::min(beyond.maxCoeff(), 0.0F);
          },
          [=](std::mt19937& random) {
            const float azimuth = Uniform(random, -kPi, kPi);
            const Vec3 radial(std::cos(azimuth), std::sin(azimuth), 0.0F);
            if (Uniform(random, 0.0F, side_m2 + caps_m2) < side_m2) {
              const float z_m =
                  Uniform(random, -half_height_m + margin_m, half_height_m - margin_m);
              return SurfacePoint{radius_m * radial + z_m * Vec3::UnitZ(), radial};
            }
            const float ring_m = (radius_m - margin_m) * std::sqrt(Uniform(random, 0.0F, 1.0F));
            const Vec3 normal =
                Uniform(random, -1.0F, 1.0F) < 0.0F ? Vec3(-Vec3::UnitZ()) : Vec3(Vec3::UnitZ());
            return SurfacePoint{ring_m * radial + half_height_m * normal, normal};
          },
          side_m2 + caps_m2};
}

/// Both, as far as they do not lie within each other.
inline Shape Together(const Shape& a, const Shape& b) {
  return {[=](const Vec3& x_m) { return std::min(a.distance_m(x_m), b.distance_m(x_m)); },
          [=](std::mt19937& random) {
            while (true) {
              const bool first = Uniform(random, 0.0F, a.area_m2 + b.area_m2) < a.area_m2;
              const SurfacePoint point = (first ? a : b).random_point(random);
              if ((first ? b : a).distance_m(point.position_m) > 0.0F) return point;
            }
          },
          a.area_m2 + b.area_m2};
}

/// The same shape elsewhere: no edge is parallel to the octree's cells by chance.
inline Shape Moved(const Shape& shape, const Transform<Object, Object>& moved_from_shape) {
  const auto shape_from_moved = moved_from_shape.Inverse();
  return {[=](const Vec3& x_m) { return shape.distance_m(shape_from_moved * x_m); },
          [=](std::mt19937& random) {
            const SurfacePoint point = shape.random_point(random);
            return SurfacePoint{moved_from_shape * point.position_m,
                                moved_from_shape.rotation() * point.normal};
          },
          shape.area_m2};
}

/// Only the part of the surface that `seen` accepts is sampled.
inline Shape Seen(const Shape& shape, std::function<bool(const Vec3&)> seen) {
  Shape partial = shape;
  partial.random_point = [=](std::mt19937& random) {
    SurfacePoint point = shape.random_point(random);
    while (!seen(point.position_m)) point = shape.random_point(random);
    return point;
  };
  return partial;
}

}  // namespace disflow::testing
