// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "disflow/flow/oriented_pair.h"
#include "disflow/flow/registration_impl.h"
#include "disflow/flow/sample_match.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// Where an object may be that was out of sight: poses that lay a pair of observed points onto a
/// pair of the model's that is as far apart and whose normals stand alike (point pair features:
/// Drost, Ulrich, Navab, Ilic, "Model globally, match locally", CVPR 2010). They need no guess to
/// begin with, wherever it is and however it was turned, and are near enough for a registration.
/// In bounded time and without tables: a few pairs in each frame, others in the next.
template <class Limits>
class PairSearch {
 public:
  using Field = DistanceField<Limits>;
  using Samples = typename Registration<Limits>::Samples;

  /// Poses that are found in one frame at most.
  static constexpr int kPoses = 8;
  /// After so many frames the same pairs come again.
  static constexpr int kParts = 4096;

  /// Keeps references to its arguments.
  /// @param part Which pairs are looked at, 0 to kParts - 1.
  PairSearch(const Field& field, const RegistrationConfig& config, const Samples& samples,
             int part) noexcept
      : field_(field),
        config_(config),
        samples_(samples),
        tolerance_m_(kToleranceOfCell * field.config().cell_size_m),
        cell_m2_(field.config().cell_size_m * field.config().cell_size_m),
        next_(static_cast<std::uint32_t>(part * kPairs * kTries)) {}

  /// The poses of those pairs at which most of the samples have surface, each turned away from the
  /// others.
  void Find() noexcept {
    poses_.clear();
    if (samples_.empty()) return;
    for (int i = 0; i < kPairs; ++i) {
      const OrientedPair observed = Choose();
      if (observed.distance_m >= 2.0F * tolerance_m_) LayOnto(observed);
    }
    std::sort(poses_.begin(), poses_.end(),
              [](const Pose& a, const Pose& b) { return a.explained > b.explained; });
  }
  /// The best first.
  [[nodiscard]] int size() const noexcept { return poses_.size(); }
  [[nodiscard]] const PoseObjectFromCamera& T_oc(int i) const noexcept { return poses_[i].T_oc; }

 private:
  /// How far both pairs' lengths may differ. Clusters' centroids lie a cell apart, so that a point
  /// is up to half a cell from the nearest; a registration corrects what this leaves.
  static constexpr float kToleranceOfCell = 0.3F;
  /// Of cosines of normals: 15 degrees across, as rough as clusters on bends are.
  static constexpr float kToleranceOfCosine = 0.25F;
  static constexpr int kPairs = 4;   ///< Observed pairs of a frame.
  static constexpr int kTries = 12;  ///< Of which each is the best.
  static constexpr int kFirst = 48;  ///< Clusters that the first of its points may lie on.
  static constexpr int kAlike = 2;   ///< Poses by each of those.
  /// Samples that a pose is judged by. It is given up if a few explain less than a share.
  static constexpr int kPoints = 24;
  static constexpr int kFew = 6;
  static constexpr float kLeast = 0.4F;
  /// Poses nearer than 17 degrees lead a registration to the same.
  static constexpr float kApart_rad = 0.3F;

  struct Pose {
    PoseObjectFromCamera T_oc;
    float explained = 0.0F;
  };

  /// A pair that tells much: far apart, on faces that stand across each other.
  [[nodiscard]] OrientedPair Choose() noexcept {
    OrientedPair best;
    float most = 0.0F;
    for (int i = 0; i < kTries; ++i, ++next_) {
      // Evenly spread over all pairs: multiples of powers of the plastic number's inverse.
      const SurfaceSample& a = SampleAt(next_ * 3242174889U);
      const SurfaceSample& b = SampleAt(next_ * 2447445414U);
      const OrientedPair pair(a.position_m, a.normal, b.position_m, b.normal);
      const float value = pair.distance_m * (0.1F + pair.normal_a.cross(pair.normal_b).norm());
      if (value <= most) continue;
      most = value;
      best = pair;
    }
    return best;
  }

  /// @param place In the list of samples, in parts of 2^32.
  [[nodiscard]] const SurfaceSample& SampleAt(std::uint32_t place) const noexcept {
    const auto size = static_cast<std::uint64_t>(samples_.size());
    return samples_[static_cast<int>((place * size) >> 32U)];
  }

  void LayOnto(const OrientedPair& observed) noexcept {
    const int stride = std::max(1, (field_.store().size() + kFirst - 1) / kFirst);
    int i = static_cast<int>(next_ % static_cast<std::uint32_t>(stride));
    field_.store().ForEach([&](Handle, const auto& first) {
      if (i++ % stride != 0) return;
      int alike = 0;
      field_.store().ForEach([&](Handle, const auto& second) {
        const Vec3 across_m = second.centroid_m - first.centroid_m;
        if (alike == kAlike || !observed.IsAsFar(across_m.squaredNorm(), tolerance_m_)) return;
        const OrientedPair known{first.centroid_m, first.mean_normal, second.centroid_m,
                                 second.mean_normal};
        if (!observed.IsLike(known, kToleranceOfCosine)) return;
        ++alike;
        Offer(observed.LaidOnto(known));
      });
    });
  }

  /// Keeps a pose if it explains more than one of those that are kept.
  void Offer(const PoseObjectFromCamera& T_oc) noexcept {
    const Pose offered{T_oc, ExplainedAt(T_oc)};
    if (offered.explained == 0.0F) return;
    Pose* least = nullptr;
    for (Pose& pose : poses_) {
      if (TurnBetween(pose.T_oc.rotation(), T_oc.rotation()).norm() < kApart_rad) {
        if (offered.explained > pose.explained) pose = offered;
        return;
      }
      if (least == nullptr || pose.explained < least->explained) least = &pose;
    }
    if (poses_.push_back(offered)) return;
    if (offered.explained > least->explained) *least = offered;
  }

  [[nodiscard]] float ExplainedAt(const PoseObjectFromCamera& T_oc) const noexcept {
    float sum = 0.0F;
    for (int i = 0; i < kPoints; ++i) {
      if (i >= kFew && sum < kLeast * static_cast<float>(i)) return 0.0F;
      const SurfaceSample& sample = SampleAt(static_cast<std::uint32_t>(i) * 2654435769U);
      const Vec3 x_m = T_oc * sample.position_m;
      const Handle nearest =
          field_.store().FindNearest(x_m, T_oc.rotation() * sample.normal,
                                     MatchRadius(sample, config_), config_.min_normal_cos);
      if (nearest == kNoHandle) continue;
      const auto& cluster = field_.store()[nearest];
      const Vec3 off_m = x_m - cluster.centroid_m;
      if (off_m.squaredNorm() > cell_m2_) continue;
      sum += Explained(cluster.mean_normal.dot(off_m), tolerance_m_ * tolerance_m_);
    }
    return sum;
  }

  const Field& field_;
  const RegistrationConfig& config_;
  const Samples& samples_;
  float tolerance_m_;
  float cell_m2_;
  std::uint32_t next_;
  FixedVector<Pose, kPoses> poses_;
};

}  // namespace disflow
