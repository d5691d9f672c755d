// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "disflow/flow/pair_search.h"
#include "disflow/flow/pose_start.h"
#include "disflow/flow/recentred.h"
#include "disflow/flow/registration_impl.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// Fast motion and loss: when the predicted pose explains the frame badly, a bounded set of other
/// starts is tried, each for a few steps, and the most plausible one wins.
template <class Limits>
class PoseSearch {
 public:
  using Field = DistanceField<Limits>;
  using RegistrationType = Registration<Limits>;
  using Model = EdgeMap<Limits::kMaxModelEdges>;

  using Start = PoseSearchStart;
  using Prior = PoseSearchPrior;

  /// Keeps references to its arguments.
  PoseSearch(RegistrationType& registration, const Field& field, const Model& edges,
             const RegistrationConfig& config, const Prior& prior) noexcept
      : registration_(registration), field_(field), edges_(edges), config_(config), prior_(prior) {}

  /// @param conflict conflict(T_oc): share of the model's visible points that the depth image
  /// contradicts, 0..1.
  template <class Conflict>
  [[nodiscard]] Start Find(const Conflict& conflict) const noexcept {
    const PoseObjectFromCamera& T_predicted = prior_.T_predicted;
    Starts starts;
    if (prior_.search == 0 && prior_.velocity_known && !prior_.contradicted &&
        registration_.Score(field_, config_, T_predicted) >= config_.hypothesis_score) {
      return prior_.unheld ? Slid(conflict) : Believed(true);
    }
    if (prior_.turned_over) {
      (void)starts.push_back(T_predicted);
      AddTurnedOver(starts);
    }
    if (prior_.global >= 0) {
      AddPairs(starts);
      return BestAndCentred(starts, conflict);
    }
    (void)starts.push_back(T_predicted);
    (void)starts.push_back(prior_.T_previous);
    (void)starts.push_back(Recentred(T_predicted));
    (void)starts.push_back(Recentred(prior_.T_previous));
    if (prior_.search == 0) {
      (void)starts.push_back(HalfWay(registration_.center_c(), prior_.T_previous, T_predicted));
    } else {
      AddTurned(starts);
    }
    return prior_.search == 0 ? Best(starts, conflict) : BestAndCentred(starts, conflict);
  }

  /// Samples that starts are compared on.
  static constexpr int kPoints = Limits::kMaxRegistrationPoints * 2 / 5;
  /// Starts that are tried in one frame at most; one more while the object is searched for.
  static constexpr int kMaxStarts = 8;

 private:
  using Starts = FixedVector<PoseObjectFromCamera, kMaxStarts>;

  /// @param held Something holds it in its place: the prediction says where it is.
  [[nodiscard]] Start Believed(bool held) const noexcept {
    return {prior_.T_predicted, prior_.T_predicted, Scale(kBelievedShare, kSearchedShare), 1, held};
  }

  /// Where a face lies whose place nothing held. Only a slide is believed: of what looks much alike
  /// at many turns, noise alone prefers another.
  template <class Conflict>
  [[nodiscard]] Start Slid(const Conflict& conflict) const noexcept {
    Starts starts;
    (void)starts.push_back(Recentred(prior_.T_predicted));
    const Start found = Best(starts, conflict);
    const ImpulsesApart apart = Apart(found.T_oc);
    return apart.turn2 > apart.shift2 ? Believed(false) : found;
  }

  /// Where what is seen may lie on the model, wherever that was.
  void AddPairs(Starts& starts) const noexcept {
    PairSearch<Limits> search(field_, config_, registration_.samples(), prior_.global);
    search.Find();
    for (int i = 0; i < search.size() && !starts.full(); ++i) {
      (void)starts.push_back(search.T_oc(i));
    }
  }

  /// Half turns about the model's principal axes.
  void AddTurnedOver(Starts& starts) const noexcept {
    Vec3 sum = Vec3::Zero();
    Mat3 squares = Mat3::Zero();
    float count = 0.0F;
    field_.store().ForEach([&](Handle, const auto& cluster) {
      const auto samples = static_cast<float>(cluster.samples.size());
      sum += samples * cluster.centroid_m;
      squares += samples * cluster.centroid_m * cluster.centroid_m.transpose();
      count += samples;
    });
    if (count < 1.0F) return;
    const Vec3 center_m = sum / count;
    const Mat3 axes = PrincipalAxes(squares / count - center_m * center_m.transpose());
    for (int i = 0; i < 3; ++i) {
      (void)starts.push_back(
          Recentred(TurnedOver(prior_.T_predicted, Vec3(axes.col(i)), center_m)));
    }
  }

  [[nodiscard]] PoseObjectFromCamera PredictedTurned(const Mat3& turn) const noexcept {
    return Recentred(
        {Mat3(turn * prior_.T_predicted.rotation()), prior_.T_predicted.translation()});
  }

  template <class Conflict>
  [[nodiscard]] Start BestAndCentred(const Starts& starts,
                                     const Conflict& conflict) const noexcept {
    Start best = Best(starts, conflict);
    // The centroid says more of the position once the rotation is right: a flat face slides.
    Starts again;
    (void)again.push_back(best.T_oc);
    (void)again.push_back(Recentred(best.T_oc));
    const int tried = best.tried + 1;
    best = Best(again, conflict);
    best.tried = tried;
    return best;
  }

  static constexpr float kEdgeShare = 0.3F;
  static constexpr float kDeviationShare = 0.15F;
  /// A nat of what the motion makes unlikely counts as much as 2 % of the surface: what a score
  /// scatters by. From 20 on, which is six deviations, it was no such motion.
  static constexpr float kTurnShare = 0.02F;
  static constexpr float kMostTurnShare = 20.0F * kTurnShare;
  static constexpr float kBelievedShare = 0.5F;
  static constexpr float kSearchedShare = 0.25F;

  [[nodiscard]] RobustScale Scale(float surface_share, float edge_share) const noexcept {
    return {surface_share * config_.robust_scale_start_m,
            edge_share * config_.robust_scale_start_m};
  }

  /// While the object is lost its rotation may be off by more than a registration corrects: a part
  /// of a grid of rotations about the predicted one, a different part in every frame, so that a
  /// frame's time stays bounded. The grid reaches 30 degrees in every direction.
  void AddTurned(Starts& starts) const noexcept {
    constexpr float kAngle_rad = 0.38F;
    for (int i = 0; !starts.full(); ++i) {
      const int index = ((prior_.search - 1) * (kMaxStarts - 4) + i) % kCubeDirections;
      (void)starts.push_back(PredictedTurned(ExpSo3(Vec3(kAngle_rad * CubeDirection(index)))));
    }
  }

  template <class Conflict>
  [[nodiscard]] Start Best(const Starts& starts, const Conflict& conflict) const noexcept {
    // A view that shows much new surface can drag a registration away from a good prediction, which
    // is therefore a candidate as it is, too.
    PoseObjectFromCamera T_best = prior_.T_predicted;
    float best = Plausibility(T_best, conflict);
    for (const PoseObjectFromCamera& T_start : starts) {
      const auto aligned = registration_.Align(field_, edges_, config_, T_start, T_start,
                                               Scale(1.0F, 1.0F), {config_.hypothesis_iterations});
      if (!aligned.solved) continue;
      const float plausibility = Plausibility(aligned.T_oc, conflict);
      if (plausibility <= best) continue;
      best = plausibility;
      T_best = aligned.T_oc;
    }
    // Where the prediction was not believed it must not pull either.
    constexpr float kBelieved = 0.3F;
    return {T_best, Deviation(T_best) > kBelieved ? T_best : prior_.T_predicted,
            Scale(kSearchedShare, kSearchedShare), starts.size()};
  }

  /// What the model explains of the frame, what the frame does not contradict of the model, and how
  /// little the motion has to change.
  template <class Conflict>
  [[nodiscard]] float Plausibility(const PoseObjectFromCamera& T_oc,
                                   const Conflict& conflict) const noexcept {
    const float deviation = Deviation(T_oc);
    // What is searched for in all directions may be far from where its motion left it; of what
    // looks alike that is taken which this makes likeliest.
    const float unlikely =
        prior_.turned_over
            ? std::min(kTurnShare * prior_.expected_turn.Unlikelihood(T_oc.rotation()),
                       kMostTurnShare)
            : kDeviationShare * deviation / (1.0F + deviation);
    return registration_.Score(field_, config_, T_oc) * (1.0F - conflict(T_oc)) +
           kEdgeShare * registration_.EdgeScore(edges_, config_, T_oc) - unlikely;
  }

  [[nodiscard]] ImpulsesApart Apart(const PoseObjectFromCamera& T_oc) const noexcept {
    return {registration_.center_c(), T_oc, prior_.T_predicted};
  }

  [[nodiscard]] float Deviation(const PoseObjectFromCamera& T_oc) const noexcept {
    const ImpulsesApart apart = Apart(T_oc);
    return apart.shift2 + apart.turn2;
  }

  [[nodiscard]] PoseObjectFromCamera Recentred(const PoseObjectFromCamera& T_oc) const noexcept {
    return disflow::Recentred(field_, T_oc, registration_.center_c());
  }

  RegistrationType& registration_;
  const Field& field_;
  const Model& edges_;
  const RegistrationConfig& config_;
  const Prior& prior_;
};

}  // namespace disflow
