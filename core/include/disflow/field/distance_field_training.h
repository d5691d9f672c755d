// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <utility>

#include "disflow/field/distance_field.h"

/// @file
/// Retraining of local GPs within a budget (section V-F). Included by distance_field.h.

namespace disflow {

template <class Limits>
int DistanceField<Limits>::Retrain(int budget, Counters& counters) noexcept {
  // The `budget` dirtiest clusters by partial selection: a small sorted list, replaced from its
  // end.
  struct Entry {
    float dirtiness;
    Handle handle;
  };
  constexpr int kMaxBatch = 64;
  int trained = 0;
  while (trained < budget) {
    FixedVector<Entry, kMaxBatch> batch;
    const int wanted = std::min(budget - trained, kMaxBatch);
    store_.ForEach([&](Handle handle, const ClusterType& cluster) {
      if (cluster.dirtiness <= 0.0F) return;
      if (batch.size() == wanted) {
        if (cluster.dirtiness <= batch.back().dirtiness) return;
        batch.truncate(wanted - 1);
      }
      (void)batch.push_back({cluster.dirtiness, handle});
      for (int i = batch.size() - 1; i > 0 && batch[i].dirtiness > batch[i - 1].dirtiness; --i) {
        std::swap(batch[i], batch[i - 1]);
      }
    });
    if (batch.empty()) break;
    for (const Entry& entry : batch) TrainCluster(store_[entry.handle], counters);
    trained += batch.size();
  }
  return trained;
}

template <class Limits>
void DistanceField<Limits>::GatherCandidates(const ClusterType& cluster, bool mature_only,
                                             Candidates& candidates,
                                             Counters& counters) const noexcept {
  const Vec3 reach = Vec3::Constant(config_.overlap_m);
  const Vec3 low = store_.tree().CellMin(cluster.cell) - reach;
  const Vec3 high = low + Vec3::Constant(config_.cell_size_m) + 2.0F * reach;
  const float value_noise = config_.value_noise_m * config_.value_noise_m;
  const float normal_noise = config_.normal_noise * config_.normal_noise;
  store_.tree().ForEachLeafInBox(low, high, [&](const OctreeCell&, Handle leaf) {
    for (Handle h = store_.tree().head(leaf); h != kNoHandle; h = store_[h].next) {
      const bool own = &store_[h] == &cluster;
      if (!own && store_[h].mean_normal.dot(cluster.mean_normal) < config_.crease_cos) continue;
      for (const ModelSample& sample : store_[h].samples) {
        if (mature_only && sample.observations < config_.mature_after) continue;
        if (!own && ((sample.position_m - low).minCoeff() < 0.0F ||
                     (high - sample.position_m).minCoeff() < 0.0F))
          continue;
        if (!own && sample.normal.dot(cluster.mean_normal) < 0.5F) continue;
        if (!candidates.push_back({sample.position_m, sample.normal,
                                   sample.variance_m2 + value_noise,
                                   sample.normal_variance + normal_noise}))
          ++counters.candidates_dropped;
      }
    }
  });
}

/// Moves the best spread subset to the front: farthest-point selection from the centre outwards.
/// @return Its size.
template <class Limits>
int DistanceField<Limits>::SpreadSelection(Candidates& candidates, const Vec3& center_m) noexcept {
  const int wanted = std::min(candidates.size(), Limits::kMaxTrainingSamples);
  std::array<float, Candidates::kCapacity> nearest_squared;
  for (int i = 0; i < candidates.size(); ++i) {
    // Negative distance from the centre: the first pick is the most central sample.
    nearest_squared[static_cast<std::size_t>(i)] =
        -(candidates[i].position_m - center_m).squaredNorm();
  }
  for (int chosen = 0; chosen < wanted; ++chosen) {
    int best = chosen;
    for (int i = chosen + 1; i < candidates.size(); ++i) {
      if (nearest_squared[static_cast<std::size_t>(i)] >
          nearest_squared[static_cast<std::size_t>(best)])
        best = i;
    }
    std::swap(candidates[chosen], candidates[best]);
    std::swap(nearest_squared[static_cast<std::size_t>(chosen)],
              nearest_squared[static_cast<std::size_t>(best)]);
    for (int i = chosen + 1; i < candidates.size(); ++i) {
      const float squared =
          (candidates[i].position_m - candidates[chosen].position_m).squaredNorm();
      float& known = nearest_squared[static_cast<std::size_t>(i)];
      known = chosen == 0 ? squared : std::min(known, squared);
    }
  }
  return wanted;
}

template <class Limits>
void DistanceField<Limits>::TrainCluster(ClusterType& cluster, Counters& counters) noexcept {
  constexpr int kMinSamples = 6;
  cluster.dirtiness = 0.0F;
  cluster.UpdateMeans();
  Candidates candidates;
  GatherCandidates(cluster, true, candidates, counters);
  // A new side has no sample that was seen often; better trained on young samples than not at all.
  if (candidates.size() < kMinSamples) {
    candidates.clear();
    GatherCandidates(cluster, false, candidates, counters);
  }
  const int count = SpreadSelection(candidates, cluster.centroid_m);
  const std::span<const GpTrainingSample> samples(candidates.begin(),
                                                  static_cast<std::size_t>(count));
  // Not positive definite only for contradicting duplicates; the cluster then falls back to its
  // plane.
  if (!workspace_.Train(samples, cluster.centroid_m, cluster.mean_normal, hyper_, cluster.gp))
    cluster.gp.Clear();
}

}  // namespace disflow
