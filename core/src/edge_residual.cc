// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/edge_residual.h"

namespace disflow {

Residual EdgeResidualOf(const EdgePoint& moved, const ModelEdge& edge, float radius_m) noexcept {
  constexpr float kMinSine = 0.3F;  // between ray and edge
  Residual residual;
  const Vec3 across = moved.ray.cross(edge.direction);
  const float sine = across.norm();
  if (sine < kMinSine) return residual;
  residual.status = ResidualStatus::kMatched;
  residual.point_m = moved.position_m;
  residual.gradient = across / sine;
  // Away from the object, as offsets of the outline are.
  if (residual.gradient.dot(moved.outward) < 0.0F) residual.gradient = -residual.gradient;
  // The model's normal is the better known: with the frame's own the offsets would be so noisy that
  // the radius would come out too small.
  residual.per_radius =
      residual.gradient.dot(edge.position_per_radius) - OutlineOffset(moved.outward, edge.normal);
  residual.distance_m =
      residual.gradient.dot(moved.position_m - edge.position_m) + radius_m * residual.per_radius;
  residual.variance_m2 = moved.variance_m2 + edge.VarianceAlong(residual.gradient);
  const float tilt_rad = moved.outward.dot(edge.direction);
  residual.tilt_rad2 = tilt_rad * tilt_rad;
  return residual;
}

}  // namespace disflow
