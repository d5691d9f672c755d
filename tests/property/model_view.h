// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "disflow/flow/registration_impl.h"
#include "model_builder.h"

namespace disflow::testing {

/// As many samples as are registered, of what faces a camera: camera frame.
inline Registration<profiles::Edge>::Samples SamplesFacing(const Shape& shape,
                                                           const PoseObjectFromCamera& T_oc) {
  Registration<profiles::Edge>::Samples samples;
  std::mt19937 random(5);
  while (!samples.full()) {
    const SurfacePoint point = shape.random_point(random);
    const Vec3 to_eye = T_oc.translation() - point.position_m;
    if (point.normal.dot(to_eye) < 0.3F * to_eye.norm()) continue;
    SurfaceSample sample = Observe(point, Observing{}, random);
    sample.position_m = T_oc.Inverse() * sample.position_m;
    sample.normal = T_oc.rotation().transpose() * sample.normal;
    (void)samples.push_back(sample);
  }
  return samples;
}

/// The samples' pose by the surface alone.
inline PoseObjectFromCamera Registered(const Registration<profiles::Edge>::Samples& samples,
                                       const EdgeField& model,
                                       const PoseObjectFromCamera& T_start) {
  const RegistrationConfig config;
  const auto registration = std::make_unique<Registration<profiles::Edge>>();
  const Registration<profiles::Edge>::Model no_model_edges{};
  const Registration<profiles::Edge>::Edges no_edges{};
  registration->SetObservations(samples, no_edges);
  return registration
      ->Align(model, no_model_edges, config, T_start, T_start, {0.003F, 0.003F},
              {config.iterations})
      .T_oc;
}

}  // namespace disflow::testing
