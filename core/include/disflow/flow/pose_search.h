// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>

#include "disflow/flow/registration.h"
#include "disflow/memory/fixed_vector.h"

namespace disflow {

/// Fast motion and loss: when the predicted pose explains the frame badly, a bounded set of other
/// starts is tried, each for a few steps, and the best explained one wins.
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

  /// What is known before a frame is registered.
  struct Prior {
    PoseObjectFromCamera T_predicted;  ///< By constant velocity.
    PoseObjectFromCamera T_previous;   ///< Of the last registered frame.
    bool velocity_known =
        false;  ///< false: the object was just started, the prediction is a guess.
    /// 0: the object was registered in the last frame. Else it has to be searched for, for the
    /// n-th frame in a row.
    int search = 0;
  };

  [[nodiscard]] static Start Find(const RegistrationType& registration, const Field& field,
                                  const Model& edges, const RegistrationConfig& config,
                                  const Prior& prior) noexcept {
    if (prior.search == 0 && prior.velocity_known &&
        registration.Score(field, config, prior.T_predicted) >= config.hypothesis_score) {
      return {prior.T_predicted, 1};
    }
    Starts starts;
    (void)starts.push_back(prior.T_predicted);
    (void)starts.push_back(prior.T_previous);
    (void)starts.push_back(Recentred(registration, field, prior.T_predicted));
    (void)starts.push_back(Recentred(registration, field, prior.T_previous));
    if (prior.search == 0) {
      (void)starts.push_back(HalfWay(registration.center_c(), prior.T_previous, prior.T_predicted));
    } else {
      AddTurned(registration, field, prior, starts);
    }
    return Best(registration, field, edges, config, starts);
  }

  /// Samples that starts are compared on.
  static constexpr int kPoints = Limits::kMaxRegistrationPoints * 2 / 5;
  /// Starts that are tried in one frame at most.
  static constexpr int kMaxStarts = 8;

 private:
  static constexpr float kEdgeShare = 0.3F;
  using Starts = FixedVector<PoseObjectFromCamera, kMaxStarts>;

  /// While the object is lost its rotation may be off by more than a registration corrects: a part
  /// of a grid of rotations about the predicted one, a different part in every frame, so that a
  /// frame's time stays bounded. The grid reaches 30 degrees in every direction.
  static void AddTurned(const RegistrationType& registration, const Field& field,
                        const Prior& prior, Starts& starts) noexcept {
    constexpr int kDirections = 14;  // the axes and the diagonals of a cube, both ways
    constexpr float kAngle_rad = 0.38F;
    for (int i = 0; !starts.full(); ++i) {
      const int index = ((prior.search - 1) * (kMaxStarts - 4) + i) % kDirections;
      const Vec3 turn = kAngle_rad * CubeDirection(index);
      const PoseObjectFromCamera turned(Mat3(ExpSo3(turn) * prior.T_predicted.rotation()),
                                        prior.T_predicted.translation());
      (void)starts.push_back(Recentred(registration, field, turned));
    }
  }

  [[nodiscard]] static Vec3 CubeDirection(int index) noexcept {
    if (index < 6) {
      Vec3 axis = Vec3::Zero();
      axis[index / 2] = index % 2 == 0 ? 1.0F : -1.0F;
      return axis;
    }
    const int corner = index - 6;
    return Vec3(corner & 1 ? 1.0F : -1.0F, corner & 2 ? 1.0F : -1.0F, corner & 4 ? 1.0F : -1.0F)
        .normalized();
  }

  [[nodiscard]] static Start Best(const RegistrationType& registration, const Field& field,
                                  const Model& edges, const RegistrationConfig& config,
                                  const Starts& starts) noexcept {
    Start best{starts[0], starts.size()};
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
    return best;
  }

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
      const auto samples = static_cast<float>(cluster.samples.size());
      sum += samples * cluster.centroid_m;
      count += samples;
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
