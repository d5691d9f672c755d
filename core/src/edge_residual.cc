// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/edge_residual.h"

namespace disflow {

Residual EdgeResidualOf(const EdgePoint& moved, const ModelEdge& edge) noexcept {
  constexpr float kMinSine = 0.3F;  // between ray and edge
  Residual residual;
  const Vec3 across = moved.ray.cross(edge.direction);
  const float sine = across.norm();
  if (sine < kMinSine) return residual;
  residual.status = ResidualStatus::kMatched;
  residual.point_m = moved.position_m;
  residual.gradient = across / sine;
  residual.distance_m = residual.gradient.dot(moved.position_m - edge.position_m);
  residual.variance_m2 = moved.variance_m2 + edge.VarianceAlong(residual.gradient);
  return residual;
}

}  // namespace disflow
