// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/field/local_gp.h"
#include "disflow/field/octree.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// A surface sample of the model: the running average of the observations near it.
struct ModelSample {
  Vec3 position_m;
  Vec3 normal;
  float variance_m2;      ///< Of the position along the normal.
  float normal_variance;  ///< Per tangential component [rad^2].
  std::uint16_t observations;
};

/// One side of the surface within one octree cell: its samples and the local GP trained on them and
/// on those nearby.
template <int kMaxSamples, int kMaxTrainingSamples>
struct Cluster {
  FixedVector<ModelSample, kMaxSamples> samples;
  LocalGp<kMaxTrainingSamples> gp;
  Vec3 centroid_m;   ///< Mean of the samples' positions.
  Vec3 mean_normal;  ///< Unit mean of the samples' normals.
  OctreeCell cell;
  Handle leaf;
  Handle next;  ///< Next cluster of the same cell, or next free one.
  bool used;
  float dirtiness;           ///< What changed since the last training, in observations.
  std::uint32_t last_frame;  ///< When it was last observed.
  /// How many pieces of surface lie between this one and the first view, each registered to the one
  /// before: errors of the pose add up along that chain.
  float generation;

  void Start(const OctreeCell& in_cell, Handle in_leaf, Handle next_in_leaf) noexcept {
    cell = in_cell;
    samples.clear();
    gp.Clear();
    leaf = in_leaf;
    next = next_in_leaf;
    used = true;
    dirtiness = 0.0F;
    last_frame = 0;
    generation = 0.0F;
  }

  void UpdateMeans() noexcept {
    Vec3 position_sum_m = Vec3::Zero();
    Vec3 normal_sum = Vec3::Zero();
    for (const ModelSample& sample : samples) {
      position_sum_m += sample.position_m;
      normal_sum += sample.normal;
    }
    centroid_m = position_sum_m / static_cast<float>(samples.size());
    const float norm = normal_sum.norm();
    mean_normal = norm > 1e-6F ? Vec3(normal_sum / norm) : samples[0].normal;
  }
};

}  // namespace disflow
