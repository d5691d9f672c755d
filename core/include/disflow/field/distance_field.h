// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/config.h"
#include "disflow/depth/surface_sample.h"
#include "disflow/field/cluster_store.h"
#include "disflow/field/field_fit.h"
#include "disflow/field/gp_workspace.h"

namespace disflow {

/// What registration needs to know of the field at an observed point.
struct FieldMatch {
  bool found = false;
  bool normal_mismatch = false;     ///< Surface is near, but none whose normal agrees.
  float distance_m = 0.0F;          ///< d
  Vec3 gradient = Vec3::Zero();     ///< grad d
  float variance_m2 = 0.0F;         ///< V[d]
  float beyond_variance_m2 = 0.0F;  ///< Its part that comes from the distance to the samples.
  float generation = 0.0F;          ///< Of the piece of surface, see Cluster.
  Handle cluster = kNoHandle;       ///< Where it was found, for DistanceField::Reuse().
};

/// What became of an observation that was offered to the model.
enum class Fusion : std::uint8_t {
  kAdded,     ///< As a new sample.
  kMerged,    ///< Averaged into the sample near it.
  kFrozen,    ///< The sample near it was seen often enough.
  kRejected,  ///< Not usable, or too far from known surface.
  kRefused,   ///< No room.
};

/// The object's surface as a signed distance field in the object frame, the zero level of d(x) as
/// in equation (3): local Gaussian processes, equation (4), in an octree (section IV). Outside is
/// positive. What makes it, Insert() and Retrain(), is defined in distance_field_fusion.h and
/// distance_field_training.h.
template <class Limits>
class DistanceField {
 public:
  using Store = ClusterStore<Limits>;
  using ClusterType = typename Store::ClusterType;

  using Match = FieldMatch;
  using Fusion = disflow::Fusion;

  /// @param coarseness By how much the field is coarser than set, see CoarsenessFor().
  void Start(const FieldConfig& config, float coarseness = 1.0F) noexcept {
    config_ = Coarser(config, coarseness);
    coarseness_ = coarseness;
    hyper_ = {config.length_scale_m, config.prior_gradient_std};
    generation_ = 0.0F;
    piece_variance_m2_ = 0.0F;
    turn_free_ = false;
    shift_free_ = false;
    store_.Start(config_.cell_size_m, config_.crease_cos);
    has_bounds_ = false;
  }

  /// Of the surface that is found from now on.
  void SetGeneration(float generation) noexcept { generation_ = generation; }
  /// Whether surface that is found from now on is found while nothing tells the turn about some
  /// axis: it may belong elsewhere about that axis.
  void SetTurnFree(bool turn_free) noexcept { turn_free_ = turn_free; }
  /// Whether it is found while the object may have slid: it may belong elsewhere. False: what was
  /// found so is where it belongs.
  void SetShiftFree(bool shift_free) noexcept {
    if (shift_free_ && !shift_free) {
      store_.ForEach([this](Handle handle, const auto&) { store_[handle].shift_free = false; });
    }
    shift_free_ = shift_free;
  }
  /// How far off a piece of surface is built into the model beside the noise of its samples and of
  /// its pose. Of all surface: as far as is known by now.
  void SetPieceVariance(float variance_m2) noexcept { piece_variance_m2_ = variance_m2; }
  [[nodiscard]] float piece_variance_m2() const noexcept { return piece_variance_m2_; }

  [[nodiscard]] const Store& store() const noexcept { return store_; }
  /// As it is: lengths are those that were set times coarseness().
  [[nodiscard]] const FieldConfig& config() const noexcept { return config_; }
  [[nodiscard]] float coarseness() const noexcept { return coarseness_; }
  [[nodiscard]] bool empty() const noexcept { return store_.size() == 0; }
  [[nodiscard]] const Vec3& bounds_min_m() const noexcept { return bounds_min_m_; }
  [[nodiscard]] const Vec3& bounds_max_m() const noexcept { return bounds_max_m_; }

  /// Distance and gradient of the surface that an observation with this normal belongs to.
  /// @param radius_m The nearest model sample is at most this far away, measured along the surface.
  [[nodiscard]] Match FindMatch(const Vec3& x_m, const Vec3& normal, float radius_m,
                                float min_cos) const noexcept {
    Match match;
    const Handle handle = store_.FindNearest(x_m, normal, radius_m, min_cos);
    if (handle == kNoHandle) {
      match.normal_mismatch = store_.FindNearest(x_m, normal, radius_m, -1.0F) != kNoHandle;
      return match;
    }
    const ClusterType& cluster = store_[handle];
    const float along_squared = TangentialDistanceSquared(cluster, x_m);
    if (along_squared > radius_m * radius_m) return match;
    // Beyond the data the surface goes on with an unknown curvature k: V = (k s^2 / 2)^2.
    const float rise_m = 0.5F * config_.unknown_curvature_per_m * along_squared;
    Evaluate(cluster, x_m, match);
    match.beyond_variance_m2 = rise_m * rise_m;
    match.variance_m2 += match.beyond_variance_m2;
    match.cluster = handle;
    return match;
  }

  /// The same piece of surface as in an earlier match, seen from a point nearby: no search.
  [[nodiscard]] Match Reuse(const Match& earlier, const Vec3& x_m) const noexcept {
    Match match;
    Evaluate(store_[earlier.cluster], x_m, match);
    match.beyond_variance_m2 = earlier.beyond_variance_m2;
    match.variance_m2 += match.beyond_variance_m2;
    match.cluster = earlier.cluster;
    return match;
  }

  /// As FindMatch(), on the octree's coarse levels: a plane per side of a larger node. For far
  /// starts.
  [[nodiscard]] Match FindCoarseMatch(const Vec3& x_m, const Vec3& normal,
                                      float min_cos) const noexcept {
    Match match;
    OctreeCell cell;
    if (!store_.tree().CellAt(x_m, cell)) return match;
    for (int up = 1; up <= Store::Tree::kCoarseLevels; ++up) {
      const auto* facet = store_.tree().FindFacet(cell, up, normal, min_cos);
      if (facet == nullptr) continue;
      match.found = true;
      match.gradient = facet->normal_sum.normalized();
      match.distance_m = match.gradient.dot(x_m - facet->position_sum_m / facet->count);
      const float size_m = config_.cell_size_m * static_cast<float>(1 << up);
      // A facet stands for a curved piece of surface: about a tenth of its size is unknown.
      match.variance_m2 = 0.01F * size_m * size_m;
      return match;
    }
    return match;
  }

  /// Takes an observation into the model: averaged into the sample near it, else as a new sample.
  /// @param observation In the object frame.
  /// @param may_extend false: known surface is refined, but none is added.
  Fusion Insert(const SurfaceSample& observation, std::uint32_t frame, Counters& counters,
                bool may_extend = true) noexcept;

  /// Takes note of a registered frame that saw a cluster where it should be, or looked through it.
  /// @return Whether it was looked through so much oftener that it is foreign: Forget() it.
  [[nodiscard]] bool Witness(Handle handle, bool seen) noexcept {
    std::int8_t& evidence = store_[handle].evidence;
    if (seen && evidence < kMostEvidence) ++evidence;
    if (!seen && evidence > -kMostContradictions) --evidence;
    return evidence <= -kMostContradictions;
  }
  /// Visits the clusters that were observed for the last time some frames ago, and none of whose
  /// samples ever was three times. Forget() them: along outlines sensors make surface up, in
  /// another place in every frame.
  /// @param visit visit(handle)
  template <class Visit>
  void ForEachUnconfirmed(std::uint32_t frame, Visit&& visit) noexcept {
    store_.ForEach([&](Handle handle, const ClusterType& cluster) {
      if (cluster.confirmed || frame - cluster.last_frame < kUnconfirmedFrames) return;
      if (cluster.samples.MostObservations() >= kConfirmingObservations) {
        store_[handle].confirmed = true;
      } else {
        visit(handle);
      }
    });
  }
  void Forget(Handle handle, Counters& counters) noexcept;

  /// Trains up to `budget` local GPs, those that changed most first. @return How many were trained.
  int Retrain(int budget, Counters& counters) noexcept;

  /// Distance and gradient as one cluster knows them.
  [[nodiscard]] float EvaluateCluster(const ClusterType& cluster, const Vec3& x_m,
                                      Vec3& gradient) const noexcept {
    Match match;
    Evaluate(cluster, x_m, match);
    gradient = match.gradient;
    return match.distance_m;
  }

  /// Squared distance along the surface from x to the cluster's nearest sample.
  [[nodiscard]] static float TangentialDistanceSquared(const ClusterType& cluster,
                                                       const Vec3& x_m) noexcept {
    const auto squared_m2 = cluster.samples.SquaredDistancesAcross(x_m, cluster.mean_normal);
    float best = 1e9F;
    for (int i = 0; i < cluster.samples.size(); ++i)
      best = std::min(best, squared_m2[static_cast<std::size_t>(i)]);
    return best;
  }

 private:
  /// Frames: a fifth of a second at 30 Hz. A pose that is off for a moment contradicts good surface
  /// for a few frames; foreign surface that was learnt is contradicted from then on.
  static constexpr std::int8_t kMostContradictions = 6;
  /// A third of a second at 30 Hz, of those tried the one that leaves least behind
  /// (docs/experiments.md, crumbs along outlines).
  static constexpr std::uint32_t kUnconfirmedFrames = 10;
  static constexpr int kConfirmingObservations = 3;
  /// So that what was seen for long can still be forgotten, in twice that time.
  static constexpr std::int8_t kMostEvidence = 8;

  /// Finite, with a unit normal and positive variances. Written so that NaN is not.
  [[nodiscard]] static bool IsUsable(const SurfaceSample& observation) noexcept {
    constexpr float kLargest = 1e6F;
    return observation.position_m.cwiseAbs().maxCoeff() < kLargest &&
           observation.position_m.allFinite() &&
           std::abs(observation.normal.squaredNorm() - 1.0F) < 0.1F &&
           observation.fused_variance_m2 > 0.0F && observation.fused_variance_m2 < kLargest &&
           observation.normal_variance >= 0.0F && observation.normal_variance < kLargest;
  }

  void Evaluate(const ClusterType& cluster, const Vec3& x_m, Match& match) const noexcept {
    match.found = true;
    match.generation = cluster.generation;
    if (cluster.gp.trained()) {
      cluster.gp.Mean(x_m, match.distance_m, match.gradient);
      match.variance_m2 = cluster.gp.SurfaceVariance();
      return;
    }
    // Not trained yet: the prior alone, whose mean is the local plane m(x) = n^T (x - c).
    match.gradient = cluster.mean_normal;
    match.distance_m = cluster.mean_normal.dot(x_m - cluster.centroid_m);
    match.variance_m2 = SlopeVariance(hyper_.prior_gradient_std, 0.5F * config_.cell_size_m);
  }

  /// The sample into which an observation is to be averaged, by its owner and its index there.
  /// @param owner kNoHandle if there is none.
  [[nodiscard]] int FindSample(const SurfaceSample& observation, Handle& owner) const noexcept;

  /// A sample that was observed often keeps still, unless a much better look at it is had.
  [[nodiscard]] bool IsFrozen(const SurfaceSample& observation, Handle owner,
                              int index) const noexcept;

  /// Kalman update of a sample's position along its normal, and of its normal.
  [[nodiscard]] Fusion Merge(const SurfaceSample& observation, Handle owner, int index) noexcept;

  [[nodiscard]] Fusion Add(const SurfaceSample& observation, std::uint32_t frame,
                           Counters& counters) noexcept;

  /// The sample's own cluster has changed, and so have those that train on it across their border.
  void MarkDirty(const ModelSample& sample, Handle owner, float change) noexcept;

  void ExtendBounds(const Vec3& x_m) noexcept {
    bounds_min_m_ = has_bounds_ ? Vec3(bounds_min_m_.cwiseMin(x_m)) : x_m;
    bounds_max_m_ = has_bounds_ ? Vec3(bounds_max_m_.cwiseMax(x_m)) : x_m;
    has_bounds_ = true;
  }

  /// A cell's surface and that around it, sampled every merge_radius_m, has about 64.
  static constexpr int kMaxCandidates = 96;
  static_assert(kMaxCandidates >= Limits::kMaxSamplesPerCluster);
  using Candidates = FixedVector<GpTrainingSample, kMaxCandidates>;
  void GatherCandidates(const ClusterType& cluster, bool mature_only, Candidates& candidates,
                        Counters& counters) const noexcept;
  [[nodiscard]] static int SpreadSelection(Candidates& candidates, const Vec3& center_m) noexcept;
  void TrainCluster(ClusterType& cluster, Counters& counters) noexcept;

  Store store_;
  GpWorkspace<Limits::kMaxTrainingSamples> workspace_;
  FieldConfig config_{};
  float coarseness_ = 1.0F;
  GpHyperparameters hyper_{};
  float generation_ = 0.0F;
  float piece_variance_m2_ = 0.0F;
  bool turn_free_ = false;
  bool shift_free_ = false;
  Vec3 bounds_min_m_ = Vec3::Zero();
  Vec3 bounds_max_m_ = Vec3::Zero();
  bool has_bounds_ = false;
};

}  // namespace disflow
