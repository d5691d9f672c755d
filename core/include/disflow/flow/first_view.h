// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/flow/pose_noise.h"
#include "disflow/types.h"

namespace disflow {

/// What the first view leaves uncertain of every pose after it. The object frame is defined by the
/// first view, whose own noise all surface of that view shares: no later residual shows it, nearer
/// or sharper views leave it, and an object at rest is off by it for good. Object axes, since it
/// turns with the object.
class FirstView {
 public:
  void Start() noexcept { *this = FirstView{}; }

  /// Takes in a followed frame.
  /// @param registered_o Covariance of its registration (origin's position, rotation), object axes.
  /// @param noise How much of that covariance poses show so far.
  /// @param outline_m What all of an outline is off by, at the object.
  void Learn(const Mat6& registered_o, const PoseNoise& noise, float outline_m) noexcept;

  /// What it leaves uncertain of a pose. Outlines of two views are off alike, and leave nothing,
  /// as far as the views are: by the cosine of the turn between them.
  /// @param R_co From the object frame, whose axes are those of the first view's camera.
  /// @param outline_m The same in this view.
  /// @return Of (origin's position, rotation), object axes.
  [[nodiscard]] Mat6 Covariance(const Mat3& R_co, float outline_m) const noexcept;

 private:
  int frames_ = 0;                    ///< That were followed, up to what is looked at.
  Mat6 registered_o_ = Mat6::Zero();  ///< Of the second view against the first.
  Vec6 noise_ = Vec6::Zero();         ///< How much of its standard deviations poses show.
  float outline_m_ = 0.0F;
};

}  // namespace disflow
