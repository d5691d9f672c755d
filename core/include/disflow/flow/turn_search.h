// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "disflow/flow/registration.h"
#include "disflow/flow/sample_match.h"
#include "disflow/flow/turn_axis.h"

namespace disflow {

/// How an object of revolution with something on it, such as a mug with its handle, is turned about
/// its axis, after nothing has told that for some time. A registration follows slopes, and a round
/// wall has none: the turn has to be looked for. What tells it are the observed samples that look
/// alike at few turns, and of the model only what was known before the turn was lost: what was
/// learnt since, at a turn that may be wrong, confirms itself. A turn is judged by where there is
/// surface, not by how little samples miss it: each side of an oval bottle is a little off, one
/// less than the other, and the bottle would turn over to that one.
template <class Limits>
class TurnSearch {
 public:
  using Field = DistanceField<Limits>;
  using Samples = typename Registration<Limits>::Samples;

  /// Of a round: 10 degrees apart, half of what a mug's handle is wide.
  static constexpr int kTurns = 36;
  /// A round is through in a tenth of a second at 30 Hz.
  static constexpr int kTurnsPerFrame = 12;
  static constexpr int kParts = kTurns / kTurnsPerFrame;
  /// Share of the samples by which wrong turns differ by chance.
  static constexpr float kScatter = 0.02F;

  /// Keeps references to its arguments.
  /// @param axis Unit axis, object frame.
  /// @param part Which turns of the round are looked at, 0 to kParts - 1.
  TurnSearch(const Field& field, const RegistrationConfig& config, const Samples& samples,
             const PoseObjectFromCamera& T_oc, const TurnAxis& axis, int part) noexcept
      : field_(field), config_(config), samples_(samples) {
    constexpr float kStep_rad = 2.0F * std::numbers::pi_v<float> / static_cast<float>(kTurns);
    poses_[0] = T_oc;
    // Those of a part are spread over the round, so that in each it shows what looks alike at few.
    for (std::size_t i = 1; i < poses_.size(); ++i) {
      const int turn = part + static_cast<int>(i - 1) * kParts + 1;
      poses_[i] = TurnedAbout(axis, kStep_rad * static_cast<float>(turn), T_oc);
    }
  }

  /// Looks for the turn that has surface for most of what has none without.
  /// @return Whether there is one, beyond chance.
  [[nodiscard]] bool Find() noexcept {
    const Gains gains = Compare();
    const auto most = std::max_element(gains.begin(), gains.end());
    best_ = static_cast<std::size_t>(most - gains.begin());
    return *most > kScatter;
  }
  /// The pose that Find() found.
  [[nodiscard]] const PoseObjectFromCamera& T_found() const noexcept { return poses_[best_]; }

  /// Whether it still has more once it is registered.
  [[nodiscard]] bool Confirms(const PoseObjectFromCamera& T_registered) noexcept {
    poses_[best_] = T_registered;
    return Compare()[best_] > kScatter;
  }

 private:
  static constexpr std::size_t kPoses = kTurnsPerFrame + 1;
  using Gains = std::array<float, kPoses>;

  /// A sample is distinct if it is explained at fewer of the turns at which there is surface.
  static constexpr float kDistinct = 0.4F;
  /// Share of all samples. Where there are more, no turn looks like another: the object has
  /// corners, and the slopes say it.
  static constexpr float kMostDistinct = 0.3F;

  /// For what share of the samples each pose has surface and the first one has not, of distinct
  /// samples alone.
  [[nodiscard]] Gains Compare() const noexcept {
    Gains gains{};
    const int wanted = std::min(config_.score_points, samples_.size());
    int distinct = 0;
    for (int i = 0; i < wanted; ++i) {
      const SampleAtEach at = AtEach(samples_[i * samples_.size() / wanted]);
      if (IsDistinct(at.explained)) ++distinct;
      if (!IsDistinct(at.near)) continue;
      for (std::size_t k = 0; k < kPoses; ++k) {
        gains[k] +=
            (std::max(at.near[k], 0.0F) - std::max(at.near[0], 0.0F)) / static_cast<float>(wanted);
      }
    }
    const auto most = kMostDistinct * static_cast<float>(wanted);
    return static_cast<float>(distinct) > most ? Gains{} : gains;
  }

  static constexpr float kNoSurface = -1.0F;

  /// What was known says of one sample at each turn; kNoSurface where nothing was.
  struct SampleAtEach {
    Gains explained{};  ///< How far.
    Gains near{};  ///< 1 where there is surface for it, 0 where that faces elsewhere or is off.
  };

  [[nodiscard]] SampleAtEach AtEach(const SurfaceSample& sample) const noexcept {
    SampleAtEach at;
    for (std::size_t k = 0; k < kPoses; ++k) {
      const PoseObjectFromCamera& T_oc = poses_[k];
      const auto match = MatchOf(field_, config_, T_oc, sample);
      if (match.normal_mismatch) continue;
      if (!match.found || field_.store()[match.cluster].turn_free) {
        at.explained[k] = kNoSurface;
        at.near[k] = kNoSurface;
        continue;
      }
      at.explained[k] = Explained(match.distance_m, sample.variance_m2 + match.variance_m2);
      at.near[k] = std::abs(match.distance_m) <= config_.match_radius_m ? 1.0F : 0.0F;
    }
    return at;
  }

  [[nodiscard]] static bool IsDistinct(const Gains& shares) noexcept {
    float sum = 0.0F;
    float known = 0.0F;
    for (const float share : shares) {
      if (share == kNoSurface) continue;
      sum += share;
      known += 1.0F;
    }
    return sum < kDistinct * known;
  }

  const Field& field_;
  const RegistrationConfig& config_;
  const Samples& samples_;
  std::array<PoseObjectFromCamera, kPoses> poses_;
  std::size_t best_ = 0;
};

}  // namespace disflow
