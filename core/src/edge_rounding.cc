// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/edge_rounding.h"

#include "disflow/field/edge_map.h"

namespace disflow {

EdgeRounding Remember(const EdgeRounding& before, const EdgeRounding& by_frame) noexcept {
  // Other edges come into view, which may be rounded otherwise.
  constexpr float kChange_m = 2e-5F;  // per frame
  const float known = 1.0F / before.variance_m2;
  const float told = std::fmax(1.0F / by_frame.variance_m2 - known, 0.0F);
  // The Kalman update with the frame's information, divided by the number of frames that err alike.
  const float share = (known + told) / (kMaxEdgeWeight * known + told);
  return {before.radius_m + share * (by_frame.radius_m - before.radius_m),
          1.0F / (known + told / kMaxEdgeWeight) + kChange_m * kChange_m};
}

}  // namespace disflow
