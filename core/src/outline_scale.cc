// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/depth/outline_scale.h"

#include <algorithm>
#include <cmath>

#include "disflow/field/edge_map.h"

namespace disflow {

void OutlineScale::Learn(OutlineSource source, float deviations) noexcept {
  // Of a pose that is off for one frame, edges tell nothing.
  constexpr float kMostDeviations = 2.0F;
  if (!(deviations > 0.0F)) return;
  float& scale = scale_[static_cast<std::size_t>(source)];
  const float ratio = std::min(deviations, kMostDeviations);
  // The model's edges err alike for as many frames as they average over.
  const float variance = scale * scale * (1.0F + (ratio * ratio - 1.0F) / kMaxEdgeWeight);
  scale = std::sqrt(std::max(variance, 1.0F));
}

}  // namespace disflow
