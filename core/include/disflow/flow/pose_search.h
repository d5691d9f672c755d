// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "disflow/flow/registration.h"

namespace disflow {

/// Fast motion: when the predicted pose explains the frame badly, a bounded set of other starts is
/// tried, each for a few steps, and the best explained one wins.
template <class Limits>
class PoseSearch {
 public:
  using Field = DistanceField<Limits>;
  using RegistrationType = Registration<Limits>;
  using Model = EdgeMap<Limits::kMaxModelEdges>;

  struct Start {
    PoseObjectFromCamera T_oc;
    int tried = 1;
  };

  /// @param T_predicted Pose by constant velocity.
  /// @param T_previous Pose of the previous frame.
  /// @param velocity_known false: the object was just started, the prediction is no more than a
  /// guess.
  [[nodiscard]] static Start Find(const RegistrationType& registration, const Field& field,
                                  const Model& edges, const RegistrationConfig& config,
                                  const PoseObjectFromCamera& T_predicted,
                                  const PoseObjectFromCamera& T_previous,
                                  bool velocity_known) noexcept {
    Start best{T_predicted, 1};
    if (velocity_known && registration.Score(field, config, T_predicted) >= config.hypothesis_score)
      return best;
    const std::array<PoseObjectFromCamera, 5> starts{
        T_predicted, T_previous, Recentred(registration, field, T_predicted),
        Recentred(registration, field, T_previous),
        HalfWay(registration.center_c(), T_previous, T_predicted)};
    float best_score = -1.0F;
    for (const PoseObjectFromCamera& T_start : starts) {
      const auto aligned =
          registration.Align(field, edges, config, T_start, T_start, config.hypothesis_iterations);
      if (!aligned.solved) continue;
      const float score = registration.Score(field, config, aligned.T_oc) +
                          kEdgeShare * registration.EdgeScore(edges, config, aligned.T_oc);
      if (score > best_score) {
        best_score = score;
        best.T_oc = aligned.T_oc;
      }
    }
    best.tried = static_cast<int>(starts.size());
    return best;
  }

 private:
  static constexpr float kEdgeShare = 0.3F;

  /// The same rotation, with the observed centroid put onto the centroid of the model's part that
  /// faces the camera.
  [[nodiscard]] static PoseObjectFromCamera Recentred(const RegistrationType& registration,
                                                      const Field& field,
                                                      const PoseObjectFromCamera& T_oc) noexcept {
    Vec3 sum = Vec3::Zero();
    float count = 0.0F;
    const Vec3& eye_o = T_oc.translation();
    field.store().ForEach([&](Handle, const auto& cluster) {
      if (cluster.mean_normal.dot(eye_o - cluster.centroid_m) <= 0.0F) return;
      sum += cluster.position_sum_m;
      count += static_cast<float>(cluster.samples.size());
    });
    if (count < 1.0F) return T_oc;
    const Vec3 shift = sum / count - T_oc * registration.center_c();
    return {T_oc.rotation(), Vec3(T_oc.translation() + shift)};
  }

  [[nodiscard]] static PoseObjectFromCamera HalfWay(const Vec3& center_c,
                                                    const PoseObjectFromCamera& a,
                                                    const PoseObjectFromCamera& b) noexcept {
    const Vec3 turn = 0.5F * LogSo3(Mat3(b.rotation() * a.rotation().transpose()));
    const Mat3 rotation = ExpSo3(turn) * a.rotation();
    const Vec3 center_o = 0.5F * (a * center_c + b * center_c);
    return {rotation, Vec3(center_o - rotation * center_c)};
  }
};

}  // namespace disflow
