// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/flow/registration_result.h"
#include "disflow/flow/residual.h"

namespace disflow {

/// How a registration goes on from step to step: how wide the robust kernels are, how points are
/// matched, and when it ends. Kernels that narrow let far residuals pull first and near ones decide
/// (graduated non-convexity).
class RegistrationPace {
 public:
  /// @param scale Widths of the kernels at the first step.
  RegistrationPace(const RobustScale& scale, const StepLimit& limit) noexcept
      : scale_(scale), limit_(limit), done_(limit.most <= 0) {}

  [[nodiscard]] bool done() const noexcept { return done_; }
  [[nodiscard]] int steps() const noexcept { return steps_; }
  /// Of the step that is next; of the last one once done.
  [[nodiscard]] const RobustScale& scale() const noexcept { return scale_; }
  [[nodiscard]] Matching matching() const noexcept { return matching_; }

  /// After a step.
  /// @param xi The step: translation [m], rotation [rad].
  /// @param std_m What the residuals of surface are known to scatter by.
  void Advance(const Vec6& xi, float std_m) noexcept;

 private:
  /// How the points are matched after a step: near the end they hardly move.
  [[nodiscard]] Matching MatchingAfter(const Vec6& xi) const noexcept;
  [[nodiscard]] bool IsDoneAfter(const Vec6& xi, float std_m) const noexcept;
  /// A prediction that was right: what it was off by is less than what the kernels are wide.
  [[nodiscard]] bool MayHurry() const noexcept;

  RobustScale scale_;
  StepLimit limit_;
  Matching matching_ = Matching::kSearch;
  int steps_ = 0;
  bool done_;
};

}  // namespace disflow
