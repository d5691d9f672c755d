// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <utility>

#include "disflow/field/distance_field.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// The distance field around a place, put together from the local GPs that know it. GPs of one side
/// are blended, so that the field is continuous across cell borders; sides that meet at a crease
/// are combined as in constructive solid geometry: the larger distance where the object is convex,
/// the smaller one where it is concave.
///
/// A view of the model: make a new one after the model has changed. Bounded work, no heap.
template <class Limits>
class LocalSurface {
 public:
  using Field = DistanceField<Limits>;
  using ClusterType = typename Field::ClusterType;

  struct Value {
    bool found = false;
    float distance_m = 0.0F;
    Vec3 gradient = Vec3::Zero();  ///< Unit length.
    Handle cluster = kNoHandle;    ///< Holder of the nearest sample.
    int nearest = 0;               ///< Which of its samples that is.
    float nearest_m = 0.0F;        ///< Distance to the nearest sample.
  };

  /// @param min_observations Samples seen less often are left out.
  explicit LocalSurface(const Field& field, int min_observations = 1) noexcept
      : field_(field),
        min_observations_(min_observations),
        blend_squared_m2_(Square(
            std::fmin(std::fmax(field.config().overlap_m, 1.5F * field.config().merge_radius_m),
                      field.config().cell_size_m))) {}

  /// Collects the clusters that matter within a box for points whose nearest sample is at most
  /// reach_m away.
  void Gather(const Vec3& low_m, const Vec3& high_m, float reach_m) noexcept {
    near_.clear();
    all_listed_ = true;
    reach_squared_m2_ = Square(reach_m);
    const Vec3 margin = Vec3::Constant(std::sqrt(reach_squared_m2_ + JoinReach()));
    low_m_ = low_m - margin;
    high_m_ = high_m + margin;
    ForEachSteady([this](Handle handle) {
      if (all_listed_) all_listed_ = near_.push_back({handle, kNoSample, 0.0F});
    });
  }

  /// Whether a gathered sample lies at most radius_m away from a box.
  [[nodiscard]] bool HasSampleNear(const Vec3& low_m, const Vec3& high_m, float radius_m) noexcept {
    bool has = false;
    ForEachGathered([&](const Near& near) {
      if (has) return;
      for (const ModelSample& sample : field_.store()[near.handle].samples) {
        const Vec3 inside = sample.position_m.cwiseMax(low_m).cwiseMin(high_m);
        has = has || (sample.position_m - inside).squaredNorm() <= Square(radius_m);
      }
    });
    return has;
  }

  /// The field at a point of the gathered box. Depends on the point alone, not on the box that was
  /// gathered.
  [[nodiscard]] Value Evaluate(const Vec3& x_m) noexcept {
    Value value;
    FindNearestSamples(x_m, value);
    if (!value.found) return value;
    Voices voices;
    SelectVoices(x_m, Square(value.nearest_m), voices);
    Combine(x_m, voices, value);
    return value;
  }

 private:
  /// So many are listed. Where more are near, all of them are looked up for every point: slow, but
  /// none is left out.
  static constexpr int kMaxNear = 192;
  static constexpr int kMaxVoices = 12;
  static constexpr int kMaxSides = 4;
  static constexpr int kNoSample = -1;

  /// A cluster near the point, and its sample nearest to it.
  struct Near {
    Handle handle;
    int sample;  ///< Its index, or kNoSample.
    float squared_m2;
  };
  using Voices = FixedVector<Near, kMaxVoices>;

  /// Weighted sums over the clusters of one side.
  struct Side {
    Vec3 direction;    ///< Unit gradient of its nearest cluster, which comes first.
    float squared_m2;  ///< Squared distance to its nearest sample.
    float weight;
    float distance_sum;
    Vec3 gradient_sum;
    Vec3 centroid_sum;
    Vec3 normal_sum;
  };

  [[nodiscard]] static float Square(float value) noexcept { return value * value; }

  /// A few samples whose normal the many around them contradict: flying pixels, mixed pixels at
  /// edges. Alone somewhere they count, for want of better.
  [[nodiscard]] bool IsStray(const ClusterType& cluster) const noexcept {
    constexpr int kMost = 3;
    constexpr int kOutvotedBy = 5;
    if (cluster.samples.size() > kMost) return false;
    int agreeing = 0;
    int others = 0;
    const float radius_m = 2.0F * std::sqrt(blend_squared_m2_);
    field_.store().ForEachNear(
        cluster.centroid_m, radius_m, [&](Handle, const ClusterType& neighbour) {
          for (const ModelSample& sample : neighbour.samples) {
            if ((sample.position_m - cluster.centroid_m).squaredNorm() > Square(radius_m)) continue;
            const bool agrees = sample.normal.dot(cluster.mean_normal) > field_.config().crease_cos;
            ++(agrees ? agreeing : others);
          }
        });
    return agreeing * kOutvotedBy < others;
  }

  /// visit(handle) for the clusters within the gathered box but the strays.
  template <class Visitor>
  void ForEachSteady(Visitor&& visit) const noexcept {
    const auto& store = field_.store();
    store.tree().ForEachLeafInBox(low_m_, high_m_, [&](const OctreeCell&, Handle leaf) {
      for (Handle h = store.tree().head(leaf); h != kNoHandle; h = store[h].next) {
        if (!IsStray(store[h])) visit(h);
      }
    });
  }

  /// visit(near) for the same clusters, from the list if all are on it.
  template <class Visitor>
  void ForEachGathered(Visitor&& visit) noexcept {
    if (all_listed_) {
      for (Near& near : near_) visit(near);
    } else {
      ForEachSteady([&](Handle handle) {
        Near near{handle, kNoSample, 0.0F};
        visit(near);
      });
    }
  }

  /// Looks for the cluster's sample nearest to x, within the square root of the bound.
  void FindNearestOf(const Vec3& x_m, float bound_squared_m2, Near& near) const noexcept {
    const auto& store = field_.store();
    near.sample = kNoSample;
    near.squared_m2 = bound_squared_m2;
    const ClusterType& cluster = store[near.handle];
    if (store.tree().DistanceSquaredToCell(x_m, cluster.cell) > near.squared_m2) return;
    const auto squared_m2 = cluster.samples.SquaredDistances(x_m);
    for (int i = 0; i < cluster.samples.size(); ++i) {
      const float squared = squared_m2[static_cast<std::size_t>(i)];
      if (squared >= near.squared_m2 || cluster.samples.observations(i) < min_observations_)
        continue;
      near.squared_m2 = squared;
      near.sample = i;
    }
  }

  void FindNearestSamples(const Vec3& x_m, Value& value) noexcept {
    float best = reach_squared_m2_;
    ForEachGathered([&](Near& near) {
      FindNearestOf(x_m, best + JoinReach(), near);
      if (near.sample == kNoSample || near.squared_m2 >= best) return;
      best = near.squared_m2;
      value.found = true;
      value.cluster = near.handle;
      value.nearest = near.sample;
    });
    value.nearest_m = std::sqrt(best);
  }

  /// The clusters that have a say, nearest first.
  void SelectVoices(const Vec3& x_m, float best_squared, Voices& voices) noexcept {
    ForEachGathered([&](Near& near) {
      if (!all_listed_) FindNearestOf(x_m, best_squared + JoinReach(), near);
      if (near.sample == kNoSample || near.squared_m2 >= best_squared + JoinReach()) return;
      if (voices.full()) {
        if (near.squared_m2 >= voices.back().squared_m2) return;
        voices.truncate(kMaxVoices - 1);
      }
      (void)voices.push_back(near);
      for (int i = voices.size() - 1; i > 0 && voices[i].squared_m2 < voices[i - 1].squared_m2;
           --i) {
        std::swap(voices[i], voices[i - 1]);
      }
    });
  }

  void Combine(const Vec3& x_m, const Voices& voices, Value& value) const noexcept {
    FixedVector<Side, kMaxSides> sides;
    for (const Near& voice : voices) {
      const ClusterType& cluster = field_.store()[voice.handle];
      Vec3 gradient;
      const float distance_m = field_.EvaluateCluster(cluster, x_m, gradient);
      const float norm = gradient.norm();
      const Vec3 direction = norm > kMinGradientNorm ? Vec3(gradient / norm) : cluster.mean_normal;
      Side* side = FindSide(direction, sides);
      if (side == nullptr) {
        if (!sides.push_back({direction, voice.squared_m2, 0.0F, 0.0F, Vec3::Zero(), Vec3::Zero(),
                              Vec3::Zero()}))
          continue;
        side = &sides.back();
      }
      const float weight =
          Square(std::fmax(1.0F - (voice.squared_m2 - side->squared_m2) / blend_squared_m2_, 0.0F));
      side->weight += weight;
      side->distance_sum += weight * distance_m;
      side->gradient_sum += weight * direction;
      side->centroid_sum += weight * cluster.centroid_m;
      side->normal_sum += weight * cluster.mean_normal;
    }
    value.found = !sides.empty();
    if (!value.found) return;
    value.distance_m = sides[0].distance_sum / sides[0].weight;
    value.gradient = sides[0].gradient_sum / sides[0].weight;
    for (int i = 1; i < sides.size(); ++i) Join(sides[0], sides[i], value);
    value.gradient.normalize();
  }

  template <class Sides>
  [[nodiscard]] Side* FindSide(const Vec3& direction, Sides& sides) const noexcept {
    for (Side& side : sides) {
      if (side.direction.dot(direction) > field_.config().crease_cos) return &side;
    }
    return nullptr;
  }

  /// Cuts the nearest side's half-space by another one (convex) or adds it (concave).
  void Join(const Side& first, const Side& other, Value& value) const noexcept {
    const Vec3 apart = first.centroid_sum / first.weight - other.centroid_sum / other.weight;
    const bool convex =
        apart.dot(first.normal_sum / first.weight - other.normal_sum / other.weight) > 0.0F;
    const float distance_m = other.distance_sum / other.weight;
    if (convex == (distance_m < value.distance_m)) return;
    // A side that comes into reach fades in: no jump.
    const float excess_m2 = other.squared_m2 - first.squared_m2;
    const float share = std::fmin((JoinReach() - excess_m2) / blend_squared_m2_, 1.0F);
    value.distance_m += share * (distance_m - value.distance_m);
    value.gradient += share * (other.gradient_sum / other.weight - value.gradient);
  }

  /// Sides whose nearest sample is this much farther away (in squares) than the nearest of all do
  /// not count. Twice the blending's: a crease's samples keep off the crease.
  [[nodiscard]] float JoinReach() const noexcept { return 2.0F * blend_squared_m2_; }

  static constexpr float kMinGradientNorm = 0.3F;

  const Field& field_;
  int min_observations_;
  float blend_squared_m2_;
  float reach_squared_m2_ = 0.0F;
  Vec3 low_m_ = Vec3::Zero();  ///< The gathered box and its margin.
  Vec3 high_m_ = Vec3::Zero();
  bool all_listed_ = true;
  FixedVector<Near, kMaxNear> near_;
};

}  // namespace disflow
