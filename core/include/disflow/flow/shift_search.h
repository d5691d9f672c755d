// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "disflow/flow/place_slip.h"
#include "disflow/flow/registration.h"
#include "disflow/flow/sample_match.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// Where along a direction an object is, such as a long box of which neither end is in view, after
/// nothing has told that for some time. The counterpart of TurnSearch: what tells it are the
/// samples that face along the direction and the edges that run across it, and of the model only
/// what was known before the place was lost: what was learnt since, at a place that may be wrong,
/// confirms itself.
template <class Limits>
class ShiftSearch {
 public:
  using Field = DistanceField<Limits>;
  using Model = EdgeMap<Limits::kMaxModelEdges>;
  using Samples = typename Registration<Limits>::Samples;
  using Edges = typename Registration<Limits>::Edges;

  /// Places that are looked at in one frame.
  static constexpr int kPlaces = 12;
  /// Share of what tells the place by which wrong places differ by chance.
  static constexpr float kScatter = 0.2F;

  /// Keeps references to its arguments.
  ShiftSearch(const Field& field, const Model& model, const RegistrationConfig& config,
              const Samples& samples, const Edges& edges, const PoseObjectFromCamera& T_oc,
              const FreeShift& shift) noexcept
      : field_(field), model_(model), config_(config), T_oc_(T_oc), T_found_(T_oc), shift_(shift) {
    const Vec3 along_c = T_oc.rotation().transpose() * shift.direction;
    TakeSome(samples, samples_, [&](const SurfaceSample& sample) {
      return std::abs(sample.normal.dot(along_c)) > kTelling;
    });
    TakeSome(edges, edges_, [&](const EdgePoint& edge) {
      return edge.steady && std::abs(edge.outward.dot(along_c)) > kTelling;
    });
  }

  /// Looks for the place where what was known explains most of what tells it.
  /// @return Whether there is one, beyond chance.
  [[nodiscard]] bool Find() noexcept {
    if (samples_.size() + edges_.size() < kFewest) return false;
    least_ = ExplainedAt(T_oc_) + kScatter;
    float most = 0.0F;
    for (int i = 0; i < kPlaces; ++i) {
      const PoseObjectFromCamera T_oc(T_oc_.rotation(),
                                      Vec3(T_oc_.translation() + shift_.Place(i, kPlaces)));
      const float explained = ExplainedAt(T_oc);
      if (explained <= most) continue;
      most = explained;
      T_found_ = T_oc;
    }
    return most > least_;
  }
  /// The pose that Find() found.
  [[nodiscard]] const PoseObjectFromCamera& T_found() const noexcept { return T_found_; }

  /// Whether it still explains more once it is registered.
  [[nodiscard]] bool Confirms(const PoseObjectFromCamera& T_registered) const noexcept {
    return ExplainedAt(T_registered) > least_;
  }

 private:
  static constexpr int kMost = 60;         ///< Samples, and edges.
  static constexpr int kFewest = 12;       ///< As registration wants.
  static constexpr float kTelling = 0.5F;  ///< Cosine: within 60 degrees of the direction.

  /// Takes those that tell, at most kMost of them, evenly spread.
  template <class All, class Some, class Tells>
  static void TakeSome(const All& all, Some& some, const Tells& tells) noexcept {
    const auto telling = static_cast<int>(std::count_if(all.begin(), all.end(), tells));
    const int every = telling / kMost + 1;
    int seen = 0;
    for (const auto& one : all) {
      if (tells(one) && seen++ % every == 0) (void)some.push_back(&one);
    }
  }

  /// Share of what tells the place that what was known explains.
  [[nodiscard]] float ExplainedAt(const PoseObjectFromCamera& T_oc) const noexcept {
    float sum = 0.0F;
    for (const SurfaceSample* const telling : samples_) {
      const SurfaceSample& sample = *telling;
      const auto match = MatchOf(field_, config_, T_oc, sample);
      if (!match.found || field_.store()[match.cluster].shift_free) continue;
      sum += Explained(match.distance_m, sample.variance_m2 + match.variance_m2);
    }
    for (const EdgePoint* const edge : edges_) {
      const EdgePoint moved = T_oc * *edge;
      const int nearest = FindNearestEdge(model_.known(), moved, config_.match_radius_m);
      if (nearest < 0) continue;
      const Residual residual = EdgeResidualOf(
          moved, model_.known()[static_cast<std::size_t>(nearest)], model_.rounding().radius_m);
      if (residual.status != ResidualStatus::kMatched) continue;
      sum += Explained(residual.distance_m, residual.variance_m2);
    }
    return sum / static_cast<float>(samples_.size() + edges_.size());
  }

  const Field& field_;
  const Model& model_;
  const RegistrationConfig& config_;
  PoseObjectFromCamera T_oc_;
  PoseObjectFromCamera T_found_;
  FreeShift shift_;
  float least_ = 0.0F;
  FixedVector<const SurfaceSample*, kMost> samples_;
  FixedVector<const EdgePoint*, kMost> edges_;
};

}  // namespace disflow
