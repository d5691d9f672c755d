// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/field_fit.h"

#include <algorithm>
#include <cmath>

namespace disflow {

float CoarsenessFor(float seen_m2, int clusters, const Config& config) noexcept {
  constexpr float kSurfacePerView = 4.0F;
  constexpr float kCellsPerSquare = 1.5F;
  const FieldConfig& field = config.field;
  if (field.fit_to_object == 0 || !(seen_m2 > 0.0F)) return 1.0F;
  const float cell_size_m =
      std::sqrt(kCellsPerSquare * kSurfacePerView * seen_m2 / static_cast<float>(clusters));
  const float coarsest = config.registration.match_radius_m / field.merge_radius_m;
  return std::clamp(cell_size_m / field.cell_size_m, 1.0F, std::max(coarsest, 1.0F));
}

FieldConfig Coarser(const FieldConfig& config, float coarseness) noexcept {
  FieldConfig coarser = config;
  coarser.cell_size_m *= coarseness;
  coarser.merge_radius_m *= coarseness;
  coarser.overlap_m *= coarseness;
  return coarser;
}

}  // namespace disflow
