// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "disflow/field/local_surface.h"
#include "disflow/field/posterior_variance.h"
#include "disflow/limits.h"
#include "disflow/status.h"

namespace disflow {

/// What the model knows of a point in the object frame.
struct DistanceQuery {
  float distance_m = 0.0F;       ///< To the surface; positive outside of the object.
  Vec3 gradient = Vec3::Zero();  ///< Unit direction in which the distance grows.
  float variance_m2 = 0.0F;      ///< Of the distance; grows away from what was seen.
  /// Seen surface is near, both along the normal (one octree cell) and along the surface (the
  /// support radius). Else the distance is that to the nearest sample of the model: good for
  /// planning, not for contact.
  bool in_bounds = false;
};

/// Answers distance queries on a model (section IV). A view: the model must not change while it
/// exists; making one costs next to nothing. Work per query is bounded by the profile's capacities.
template <CapacityProfile Limits>
class DistanceQuerier {
 public:
  using Field = DistanceField<Limits>;
  using Workspace = GpWorkspace<Limits::kMaxTrainingSamples>;
  using Surface = LocalSurface<Limits>;

  /// @param workspace Scratch memory of the caller; may lie in static memory and be reused.
  /// @param support_radius_m Surface is taken as known up to this far from a sample; as much
  ///     farther as the field is coarser than set.
  DistanceQuerier(const Field& field, Workspace& workspace, float support_radius_m) noexcept
      : field_(field),
        surface_(field),
        variance_(field, workspace),
        support_radius_m_(field.coarseness() * support_radius_m),
        spacing_m_(std::fmin(field.config().merge_radius_m, 0.5F * field.config().cell_size_m)) {}

  /// @param x_m Any point, object frame.
  /// @return kNotInitialised if the model is empty, kOutOfBounds if a coordinate of x is not finite
  ///     or beyond 1e6 m.
  [[nodiscard]] Expected<DistanceQuery> Query(const Vec3& x_m) noexcept {
    Expected<DistanceQuery> result;
    if (field_.empty()) {
      result.status = Status::kNotInitialised;
    } else if (!x_m.allFinite() || x_m.cwiseAbs().maxCoeff() > kFarthest_m) {
      result.status = Status::kOutOfBounds;
    } else {
      result.value = QueryFinite(x_m);
    }
    return result;
  }

 private:
  static constexpr float kFarthest_m =
      1e6F;  ///< Beyond, squares lose their meaning in single precision.

  [[nodiscard]] DistanceQuery QueryFinite(const Vec3& x_m) noexcept {
    const float near_m = field_.config().cell_size_m;
    surface_.Gather(x_m, x_m, near_m);
    const typename Surface::Value local = surface_.Evaluate(x_m);
    if (!local.found) return QueryFar(x_m);
    DistanceQuery query{local.distance_m, local.gradient,
                        variance_.At(local.cluster, x_m, local.nearest_m), false};
    const ModelSample nearest = field_.store()[local.cluster].samples[local.nearest];
    const float height_m = nearest.normal.dot(x_m - nearest.position_m);
    const float tangential_m2 = local.nearest_m * local.nearest_m - height_m * height_m;
    query.in_bounds = tangential_m2 <= support_radius_m_ * support_radius_m_;
    // The GP knows the shape near the surface, the nearest sample the distance far from it; one
    // fades into the other.
    const float share = (local.nearest_m - 0.5F * near_m) / (0.5F * near_m);
    if (share <= 0.0F) return query;
    return Mix(query, FromSample(x_m, nearest, local.nearest_m, query),
               share * share * (3.0F - 2.0F * share));
  }

  [[nodiscard]] DistanceQuery QueryFar(const Vec3& x_m) noexcept {
    ModelSample nearest;
    Handle owner = kNoHandle;
    float squared_m2 = 1e30F;
    const auto& store = field_.store();
    store.tree().VisitNearestFirst(x_m, squared_m2, [&](Handle leaf, float& bound_squared_m2) {
      for (Handle h = store.tree().head(leaf); h != kNoHandle; h = store[h].next) {
        for (const ModelSample& sample : store[h].samples) {
          const float squared = (sample.position_m - x_m).squaredNorm();
          if (squared >= bound_squared_m2) continue;
          bound_squared_m2 = squared;
          nearest = sample;
          owner = h;
        }
      }
    });
    if (owner == kNoHandle) return {};
    const float nearest_m = std::sqrt(squared_m2);
    // No surface lies between x and its nearest sample: x is on the same side as a point just off
    // that sample.
    const Vec3 beside_m =
        nearest_m > 0.0F
            ? Vec3(nearest.position_m + (x_m - nearest.position_m) * (spacing_m_ / nearest_m))
            : Vec3(nearest.position_m + nearest.normal * spacing_m_);
    surface_.Gather(beside_m, beside_m, 2.0F * spacing_m_);
    const typename Surface::Value local = surface_.Evaluate(beside_m);
    const DistanceQuery beside{local.distance_m, local.gradient,
                               variance_.At(owner, beside_m, spacing_m_), false};
    return FromSample(x_m, nearest, nearest_m, beside);
  }

  /// Distance to the disc of surface around a sample.
  /// @param beside The field at x or between x and the sample: says which side x is on.
  [[nodiscard]] DistanceQuery FromSample(const Vec3& x_m, const ModelSample& sample,
                                         float nearest_m,
                                         const DistanceQuery& beside) const noexcept {
    const Vec3 offset = x_m - sample.position_m;
    const float height_m = sample.normal.dot(offset);
    const float tangential_m =
        std::sqrt(std::fmax(nearest_m * nearest_m - height_m * height_m, 0.0F));
    const float beyond_m = std::fmax(tangential_m - 0.5F * spacing_m_, 0.0F);
    const Vec3 across = sample.normal * height_m;
    const Vec3 away =
        tangential_m > 0.0F ? Vec3(across + (offset - across) * (beyond_m / tangential_m)) : across;
    const float distance_m = away.norm();
    const float sign = beside.distance_m < 0.0F ? -1.0F : 1.0F;
    DistanceQuery query;
    query.distance_m = sign * distance_m;
    query.gradient = distance_m > 0.0F ? Vec3(away * (sign / distance_m)) : sample.normal;
    query.variance_m2 = beside.variance_m2 + variance_.OfSlope(nearest_m);
    return query;
  }

  [[nodiscard]] static DistanceQuery Mix(const DistanceQuery& near, const DistanceQuery& far,
                                         float share) noexcept {
    DistanceQuery query = near;
    query.distance_m += share * (far.distance_m - near.distance_m);
    query.gradient = (near.gradient + share * (far.gradient - near.gradient)).normalized();
    query.variance_m2 += share * (far.variance_m2 - near.variance_m2);
    return query;
  }

  const Field& field_;
  Surface surface_;
  PosteriorVariance<Limits> variance_;
  float support_radius_m_;
  float spacing_m_;  ///< Of the model's samples.
};

extern template class DistanceQuerier<profiles::Micro>;
extern template class DistanceQuerier<profiles::Edge>;
extern template class DistanceQuerier<profiles::Dense>;

}  // namespace disflow
