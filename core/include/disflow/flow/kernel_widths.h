// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace disflow {

/// How wide the robust kernels end, in multiples of RegistrationConfig::robust_scale_sigmas. What
/// is farther off than most is an outlier; but where noise is all that residuals have, a kernel as
/// narrow as one standard deviation throws more than half of what they tell away. How far a
/// sensor's residuals spread beside what they are known to is learnt.
class KernelWidths {
 public:
  [[nodiscard]] float of_surface() const noexcept { return surface_.width; }
  [[nodiscard]] float of_edges() const noexcept { return edges_.width; }

  /// Takes over what a frame's registered residuals told.
  /// @param surface,edges Their spreads in their standard deviations, see SpreadOf(); what is not
  ///     positive says nothing.
  void Learn(float surface, float edges) noexcept;

 private:
  struct Kind {
    float spread = 0.0F;  ///< Followed; 0 before the first.
    float width = 1.0F;
  };
  static void Learn(Kind& kind, float spread) noexcept;

  Kind surface_;
  Kind edges_;
};

}  // namespace disflow
