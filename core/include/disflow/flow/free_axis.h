// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/types.h"

namespace disflow {

/// The axis about which nothing tells an object's turn. It is the object's own, so what single
/// frames say of where it lies is averaged in the object frame; how they differ is how well it is
/// known. That matters where the turn may be anything: an axis that is off by a degree, and a turn
/// of a hundred, tilt the object by two.
class FreeAxis {
 public:
  void Forget() noexcept { frames_ = 0; }

  /// Averages what a frame says. Another axis than before takes its place; one beside it does not.
  /// @param free_turn Sum of u u^T as PoseUncertainty::free_turn, of the object's origin, object
  /// axes. Zero tells nothing.
  void Learn(const Mat6& free_turn) noexcept;

  /// What is known of the axis.
  /// @param free_turn By one frame, as above.
  [[nodiscard]] Mat6 Steadied(const Mat6& free_turn) const noexcept;

  /// Whether frames agree that there is one such axis and where it lies, and this one does, too.
  /// What is round like a ball turns about others as well, and a bowl does while it is seen from
  /// below.
  /// @param free_turn By one frame, as above.
  [[nodiscard]] bool IsOne(const Mat6& free_turn) const noexcept;

  /// The same of a frame that leaves the turn about that axis free, whatever else it does.
  [[nodiscard]] bool Leaves(const Mat6& free_turn) const noexcept;

  /// What is known of the axis if there is one.
  [[nodiscard]] const Mat6& mean() const noexcept { return mean_; }

 private:
  [[nodiscard]] bool IsKnown() const noexcept;
  [[nodiscard]] bool IsSame(const Mat6& free_turn) const noexcept;

  Mat6 mean_ = Mat6::Zero();
  int frames_ = 0;
};

}  // namespace disflow
