// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/field/distance_field.h"

/// @file
/// How observations become samples of the distance field: definitions of members of DistanceField.

namespace disflow {

template <class Limits>
Fusion DistanceField<Limits>::Insert(const SurfaceSample& observation, std::uint32_t frame,
                                     Counters& counters, bool may_extend) noexcept {
  if (!IsUsable(observation)) {
    ++counters.observations_rejected;
    return Fusion::kRejected;
  }
  Handle owner = kNoHandle;
  const int nearest = FindSample(observation, owner);
  if (owner != kNoHandle && IsFrozen(observation, owner, nearest)) {
    store_[owner].last_frame = frame;
    return Fusion::kFrozen;
  }
  if (owner == kNoHandle && !may_extend) {
    ++counters.observations_rejected;
    return Fusion::kRejected;
  }
  const Match match = FindMatch(observation.position_m, observation.normal,
                                config_.merge_radius_m * 2.0F, config_.crease_cos);
  if (match.found) {
    const float sigma_m = std::sqrt(observation.fused_variance_m2 + match.variance_m2);
    if (std::abs(match.distance_m) > config_.reject_floor_m + 3.0F * sigma_m) {
      ++counters.observations_rejected;
      return Fusion::kRejected;
    }
  }
  if (owner != kNoHandle) {
    store_[owner].last_frame = frame;
    return Merge(observation, owner, nearest);
  }
  return Add(observation, frame, counters);
}

template <class Limits>
int DistanceField<Limits>::FindSample(const SurfaceSample& observation,
                                      Handle& owner) const noexcept {
  constexpr float kSimilarNormalCos = 0.8F;
  owner = kNoHandle;
  int nearest = 0;
  float nearest_squared = config_.merge_radius_m * config_.merge_radius_m;
  store_.ForEachNear(
      observation.position_m, config_.merge_radius_m,
      [&](Handle handle, const ClusterType& cluster) {
        if (cluster.mean_normal.dot(observation.normal) < 0.5F) return;
        const auto squared_m2 = cluster.samples.SquaredDistances(observation.position_m);
        for (int i = 0; i < cluster.samples.size(); ++i) {
          const float squared = squared_m2[static_cast<std::size_t>(i)];
          if (squared < nearest_squared &&
              cluster.samples.normal(i).dot(observation.normal) > kSimilarNormalCos) {
            nearest_squared = squared;
            nearest = i;
            owner = handle;
          }
        }
      });
  return nearest;
}

template <class Limits>
bool DistanceField<Limits>::IsFrozen(const SurfaceSample& observation, Handle owner,
                                     int index) const noexcept {
  const auto& samples = store_[owner].samples;
  return samples.observations(index) >= config_.freeze_after &&
         !(observation.fused_variance_m2 < 0.25F * samples.variance_m2(index));
}

template <class Limits>
Fusion DistanceField<Limits>::Merge(const SurfaceSample& observation, Handle owner,
                                    int index) noexcept {
  ModelSample sample = store_[owner].samples[index];
  const Vec3 offset = observation.position_m - sample.position_m;
  const float cosine = observation.normal.dot(sample.normal);
  // Two points of an arc lie on a chord that is perpendicular to the mean of their normals.
  const float shift_m = offset.dot(observation.normal + sample.normal) / (1.0F + cosine);
  const float tilt_variance = 0.25F * offset.squaredNorm() * observation.normal_variance;
  const float gain =
      sample.variance_m2 / (sample.variance_m2 + observation.fused_variance_m2 + tilt_variance);
  sample.position_m += gain * shift_m * sample.normal;
  sample.variance_m2 *= 1.0F - gain;
  const float normal_gain =
      sample.normal_variance / (sample.normal_variance + observation.normal_variance + 1e-6F);
  sample.normal = (sample.normal + normal_gain * (observation.normal - sample.normal)).normalized();
  sample.normal_variance *= 1.0F - normal_gain;
  if (sample.observations < 65535) ++sample.observations;
  store_[owner].samples.Set(index, sample);
  MarkDirty(sample, owner, 1.0F);
  return Fusion::kMerged;
}

template <class Limits>
Fusion DistanceField<Limits>::Add(const SurfaceSample& observation, std::uint32_t frame,
                                  Counters& counters) noexcept {
  const Handle handle =
      store_.FindOrCreate(observation.position_m, observation.normal, frame, counters);
  if (handle == kNoHandle) return Fusion::kRefused;
  ClusterType& cluster = store_[handle];
  cluster.last_frame = frame;
  if (cluster.samples.empty()) {
    cluster.generation = generation_;
    cluster.turn_free = turn_free_;
    cluster.shift_free = shift_free_;
  }
  const ModelSample sample{observation.position_m, observation.normal,
                           observation.fused_variance_m2, observation.normal_variance, 1};
  if (!cluster.samples.push_back(sample)) {
    ++counters.samples_refused;
    return Fusion::kRefused;
  }
  cluster.UpdateMeans();
  store_.OnSampleAdded(cluster, sample);
  ExtendBounds(sample.position_m);
  MarkDirty(sample, handle, 1.0F);
  return Fusion::kAdded;
}

template <class Limits>
void DistanceField<Limits>::MarkDirty(const ModelSample& sample, Handle owner,
                                      float change) noexcept {
  constexpr float kNeighbourShare = 0.3F;
  store_.ForEachNear(sample.position_m, config_.overlap_m,
                     [&](Handle handle, const ClusterType& cluster) {
                       if (handle == owner) {
                         store_[handle].dirtiness += change;
                       } else if (cluster.mean_normal.dot(sample.normal) > config_.crease_cos) {
                         store_[handle].dirtiness += kNeighbourShare * change;
                       }
                     });
}

template <class Limits>
void DistanceField<Limits>::Forget(Handle handle, Counters& counters) noexcept {
  const Vec3 centroid_m = store_[handle].centroid_m;
  store_.Forget(handle, counters);
  // Those around it have trained on its samples across their border.
  store_.ForEachNear(centroid_m, config_.cell_size_m,
                     [this](Handle near, const ClusterType&) { store_[near].dirtiness += 1.0F; });
}

}  // namespace disflow
