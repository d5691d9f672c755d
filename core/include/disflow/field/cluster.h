// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/field/facet_pool.h"
#include "disflow/field/local_gp.h"
#include "disflow/field/octree_cell.h"
#include "disflow/field/sample_list.h"

namespace disflow {

/// One side of the surface within one octree cell: its samples and the local GP trained on them and
/// on those nearby.
template <int kMaxSamples, int kMaxTrainingSamples>
struct Cluster {
  // What every search looks at comes first, next to each other.
  Vec3 centroid_m;   ///< Mean of the samples' positions.
  Vec3 mean_normal;  ///< Unit mean of the samples' normals.
  OctreeCell cell;
  Handle leaf;
  Handle next;  ///< Next cluster of the same cell, or next free one.
  bool used;
  /// Frames that saw it where it should be, less those that looked through it; bounded, see
  /// DistanceField::Witness().
  std::int8_t evidence;
  bool confirmed;            ///< Some of it was observed again, see ForEachUnconfirmed().
  bool turn_free : 1;        ///< Found while nothing told the turn about some axis.
  bool shift_free : 1;       ///< Found while the object may have slid, see PlaceSlip.
  float dirtiness;           ///< What changed since the last training, in observations.
  std::uint32_t last_frame;  ///< When it was last observed.
  /// How many pieces of surface lie between this one and the first view, each registered to the one
  /// before: errors of the pose add up along that chain. Each counts as often as the variance of
  /// its pose was that which the registration stated, see PoseNoise.
  float generation;

  SampleList<kMaxSamples> samples;
  LocalGp<kMaxTrainingSamples> gp;

  /// @param cell_min_m Corner of the cell.
  void Start(const OctreeCell& in_cell, const Vec3& cell_min_m, float cell_size_m, Handle in_leaf,
             Handle next_in_leaf) noexcept {
    // Samples wander while they are averaged, but not across the next cell.
    constexpr float kReach = 2.0F;
    cell = in_cell;
    samples.Start(cell_min_m + Vec3::Constant(0.5F * cell_size_m), kReach * cell_size_m);
    gp.Clear();
    leaf = in_leaf;
    next = next_in_leaf;
    used = true;
    evidence = 0;
    confirmed = false;
    turn_free = false;
    shift_free = false;
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
