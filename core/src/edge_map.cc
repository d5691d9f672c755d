// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/field/edge_map.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "disflow/field/meeting_faces.h"

namespace disflow {
namespace {

[[nodiscard]] bool EndsSameFace(const ModelEdge& edge, const EdgePoint& point) noexcept {
  constexpr float kSimilarNormalCos = 0.8F;
  return edge.normal.dot(point.normal) > kSimilarNormalCos;
}

/// Whether the face that ends at a point may be the other one that meets at the edge: it turns away
/// by enough, and each passes near the place of the other's end. Outlines of round things that have
/// turned by 60 degrees lie half a radius off each other's planes.
[[nodiscard]] bool EndsOtherFace(const ModelEdge& edge, const EdgePoint& point) noexcept {
  if (edge.normal.dot(point.normal) > kMeetingCos) return false;
  const float reach_m = MergeRadius(point, kMeetingReach_m);
  const Vec3 apart_m = edge.position_m - point.position_m;
  return std::abs(edge.normal.dot(apart_m)) < reach_m &&
         std::abs(point.normal.dot(apart_m)) < reach_m;
}

/// Kalman update with the position along one unit vector.
/// @param per_radius What rounding adds to the position seen along it, per radius.
void Update(const Vec3& unit, const Vec3& position_m, float per_radius, float variance_m2,
            const Mat<float, 3, 2>& across, ModelEdge& edge) noexcept {
  const Vec2 row = across.transpose() * unit;
  const Vec2 p_row = edge.covariance * row;
  const float innovation_m2 = row.dot(p_row) + variance_m2;
  const Vec3 gain = across * p_row / innovation_m2;
  edge.position_m += unit.dot(position_m - edge.position_m) * gain;
  edge.position_per_radius += (per_radius - unit.dot(edge.position_per_radius)) * gain;
  // Symmetric to the bit: what is not would grow.
  edge.covariance -= p_row * p_row.transpose() / innovation_m2;
}

/// The outline in the image, and, by the depth, how far along the ray it is.
void Observe(const EdgePoint& point, ModelEdge& edge) noexcept {
  const Mat<float, 3, 2> across = edge.Across();
  const float offset = OutlineOffset(point.outward, edge.normal);
  Update(point.outward, point.position_m, offset, point.variance_m2, across, edge);
  const Vec3 back = edge.direction.cross(point.outward);
  const float along_ray = point.ray.dot(back);
  // The point was placed where its ray meets the face, which tells little where the two run alike.
  constexpr float kLeastFacing = 0.1F;
  const Vec3& face = EndsSameFace(edge, point) ? edge.normal : point.normal;
  const float facing = face.dot(back);
  const float per_radius =
      std::abs(facing) < kLeastFacing ? 0.0F : -offset * face.dot(point.outward) / facing;
  Update(back, point.position_m, per_radius,
         point.variance_m2 + point.depth_variance_m2 * along_ray * along_ray, across, edge);
}

}  // namespace

Mat<float, 3, 2> ModelEdge::Across() const noexcept {
  Mat<float, 3, 2> across;
  across.col(0) = normal.cross(direction).normalized();
  across.col(1) = direction.cross(across.col(0));
  return across;
}

float ModelEdge::VarianceAlong(const Vec3& unit) const noexcept {
  const Vec2 row = Across().transpose() * unit;
  return row.dot(covariance * row);
}

ModelEdge MakeModelEdge(const EdgePoint& point, std::uint32_t frame) noexcept {
  constexpr float kAnywhere_m = 0.1F;
  ModelEdge edge{point.position_m,        Vec3::Zero(), point.direction, point.normal, frame, 1.0F,
                 Mat<float, 2, 2>::Zero()};
  edge.covariance.diagonal().setConstant(kAnywhere_m * kAnywhere_m);
  Observe(point, edge);
  return edge;
}

bool IsSeenAs(const ModelEdge& edge, const EdgePoint& point) noexcept {
  constexpr float kMostTurnSin = 0.34F;  // 20 degrees
  const float least_weight = point.steady ? 0.0F : kWellKnownWeight;
  return edge.weight >= least_weight &&
         std::abs(edge.direction.dot(point.outward)) < kMostTurnSin &&
         (EndsSameFace(edge, point) || EndsOtherFace(edge, point));
}

int FindNearestEdge(std::span<const ModelEdge> edges, const EdgePoint& point,
                    float radius_m) noexcept {
  int nearest = -1;
  float nearest_squared = radius_m * radius_m;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    // Most are far off along any one axis.
    const float along_x_m = edges[i].position_m.x() - point.position_m.x();
    if (along_x_m * along_x_m >= nearest_squared) continue;
    const float squared = (edges[i].position_m - point.position_m).squaredNorm();
    if (squared < nearest_squared && IsSeenAs(edges[i], point)) {
      nearest_squared = squared;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

void MergeIntoEdge(const EdgePoint& point, std::uint32_t frame, ModelEdge& edge) noexcept {
  edge.last_seen = frame;
  // What is old is believed less, so that an edge can still move.
  if (edge.weight >= kMaxEdgeWeight) edge.covariance *= (kMaxEdgeWeight + 1.0F) / kMaxEdgeWeight;
  Observe(point, edge);
  const float gain = 1.0F / (edge.weight + 1.0F);
  const float sign = edge.direction.dot(point.direction) < 0.0F ? -1.0F : 1.0F;
  edge.direction = (edge.direction + gain * (sign * point.direction - edge.direction)).normalized();
  if (EndsSameFace(edge, point))
    edge.normal = (edge.normal + gain * (point.normal - edge.normal)).normalized();
  edge.weight = std::fmin(edge.weight + 1.0F, kMaxEdgeWeight);
}

int FindForgettable(std::span<const ModelEdge> edges, std::uint32_t frame) noexcept {
  constexpr float kKnownWeight = 3.0F;
  const auto rank = [](const ModelEdge& edge) {
    return std::pair(edge.weight >= kKnownWeight, edge.last_seen);
  };
  const ModelEdge* found = nullptr;
  for (const ModelEdge& edge : edges) {
    if (edge.last_seen == frame) continue;
    if (found == nullptr || rank(edge) < rank(*found)) found = &edge;
  }
  return found == nullptr ? -1 : static_cast<int>(found - edges.data());
}

float MergeRadius(const EdgePoint& point, float merge_radius_m) noexcept {
  constexpr float kSigmas = 2.0F;
  return std::sqrt(merge_radius_m * merge_radius_m + kSigmas * kSigmas * point.depth_variance_m2);
}

}  // namespace disflow
