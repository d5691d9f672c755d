// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow {

/// How wide the surface's robust kernel ends, in multiples of
/// RegistrationConfig::robust_scale_sigmas. What is farther off than most is an outlier; but where
/// noise is all that residuals have, a kernel as narrow as one standard deviation throws more than
/// half of what they tell away. How far a sensor's residuals spread beside what they are known to
/// is learnt. Not the edges': what they are off by is often no noise.
class KernelWidth {
 public:
  [[nodiscard]] float factor() const noexcept { return factor_; }

  /// Takes over what a frame's registered residuals told.
  /// @param spread Theirs in their standard deviations, see SpreadOf(); what is not positive says
  ///     nothing.
  void Learn(float spread) noexcept;

 private:
  float spread_ = 0.0F;  ///< Followed; 0 before the first.
  float factor_ = 1.0F;
};

}  // namespace disflow
