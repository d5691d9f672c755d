// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <memory>
#include <random>

#include "disflow/field/distance_field_fusion.h"
#include "disflow/field/distance_field_training.h"
#include "disflow/limits.h"
#include "shapes.h"

namespace disflow::testing {

using EdgeField = DistanceField<profiles::Edge>;

struct Observing {
  float noise_m = 0.0F;
  float normal_noise = 0.0F;  ///< Per tangential component [rad].
  int passes = 5;             ///< How often the whole surface is seen.
  float density_per_m2 = 1.5e5F;
  unsigned seed = 1;
};

/// What a sensor with this noise makes of a surface point.
inline SurfaceSample Observe(const SurfacePoint& point, const Observing& observing,
                             std::mt19937& random) {
  std::normal_distribution<float> gaussian;
  const float sigma_m = std::max(observing.noise_m, 1e-4F);
  const float tilt = std::max(observing.normal_noise, 0.01F);
  SurfaceSample sample;
  sample.position_m = point.position_m + observing.noise_m * gaussian(random) * point.normal;
  const Vec3 shake(gaussian(random), gaussian(random), gaussian(random));
  sample.normal = (point.normal + observing.normal_noise * shake).normalized();
  sample.variance_m2 = sample.fused_variance_m2 = sigma_m * sigma_m;
  sample.normal_variance = tilt * tilt;
  return sample;
}

/// Inserts random observations of a shape and retrains all that changed.
template <class Field>
void Fuse(const Shape& shape, const Observing& observing, std::uint32_t first_frame, Field& field,
          Counters& counters) {
  std::mt19937 random(observing.seed);
  const auto count = static_cast<int>(observing.density_per_m2 * shape.area_m2);
  for (int pass = 0; pass < observing.passes; ++pass) {
    for (int i = 0; i < count; ++i) {
      const SurfaceSample sample = Observe(shape.random_point(random), observing, random);
      (void)field.Insert(sample, first_frame + static_cast<std::uint32_t>(pass), counters);
    }
    (void)field.Retrain(std::numeric_limits<int>::max(), counters);
  }
}

/// A model of a shape. Fields are too large for the stack.
inline std::unique_ptr<EdgeField> MakeModel(const Shape& shape, const Observing& observing = {},
                                            const FieldConfig& config = {}) {
  auto field = std::make_unique<EdgeField>();
  field->Start(config);
  Counters counters;
  Fuse(shape, observing, 1, *field, counters);
  return field;
}

/// Somewhere between the octree's cells, no axis along theirs.
inline Transform<Object, Object> OddPlace() {
  Vec6 xi;
  xi << 0.0037F, -0.0061F, 0.0023F, 0.35F, -0.52F, 0.21F;
  return Transform<Object, Object>::Exp(xi);
}

inline Shape OddBox() { return Moved(Box(Vec3(0.04F, 0.03F, 0.02F), 0.0015F), OddPlace()); }
inline Shape OddSphere() { return Sphere(0.04F, OddPlace().translation()); }
inline Shape OddCylinder() { return Moved(Cylinder(0.03F, 0.05F, 0.0015F), OddPlace()); }
inline Shape OddPlane() { return Moved(Plane(0.06F), OddPlace()); }

}  // namespace disflow::testing
