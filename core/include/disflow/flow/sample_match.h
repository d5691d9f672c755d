// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/flow/surface_residual.h"

namespace disflow {

/// What the model has near an observed sample under a pose, by the gates of the registration.
/// @param observed Camera frame.
template <class Field>
[[nodiscard]] typename Field::Match MatchOf(const Field& field, const RegistrationConfig& config,
                                            const PoseObjectFromCamera& T_oc,
                                            const SurfaceSample& observed) noexcept {
  return field.FindMatch(T_oc * observed.position_m, T_oc.rotation() * observed.normal,
                         MatchRadius(observed, config), config.min_normal_cos);
}

}  // namespace disflow
