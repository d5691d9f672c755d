// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/depth/surface_sample.h"
#include "disflow/geometry/transform.h"

namespace disflow {

/// How far an observed occluding edge lies from the model's edge, object frame.
template <class ModelEdge>
struct EdgeResidual {
  bool found = false;
  const ModelEdge* edge = nullptr;
  Vec3 position_m = Vec3::Zero();
  Vec3 gradient = Vec3::Zero();
  float residual_m = 0.0F;
  float sigma_m = 0.0F;
};

/// @param radius_m The edge is searched for this far around.
/// @param known The edge, when it was found before.
template <class EdgeMapType, class ModelEdge = typename EdgeMapType::Edge>
[[nodiscard]] EdgeResidual<ModelEdge> FindEdge(const EdgeMapType& model_edges, float edge_std_px,
                                               const EdgePoint& point,
                                               const PoseObjectFromCamera& T_oc, float radius_m,
                                               const ModelEdge* known = nullptr) noexcept {
  constexpr float kFewestSine = 0.3F;
  const EdgePoint moved = T_oc * point;
  EdgeResidual<ModelEdge> result;
  const auto* edge = known != nullptr ? known : model_edges.FindNearest(moved, radius_m);
  if (edge == nullptr) return result;
  result.edge = edge;
  // The outline in the image moves only across the ray and across the edge.
  const Vec3 across = moved.ray.cross(edge->direction);
  const float sine = across.norm();
  if (sine < kFewestSine) return result;  // the edge points at the camera
  result.found = true;
  result.position_m = moved.position_m;
  result.gradient = across / sine;
  result.residual_m = result.gradient.dot(moved.position_m - edge->position_m);
  result.sigma_m = edge_std_px * point.pixel_m;
  return result;
}

}  // namespace disflow
