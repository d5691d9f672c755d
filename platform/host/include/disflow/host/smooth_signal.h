// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "disflow/host/random.h"

namespace disflow::host {

/// A sum of sinusoids with random phases, |Value| <= 1, all derivatives continuous.
class SmoothSignal {
 public:
  SmoothSignal() = default;
  /// @param frequency_hz Of the strongest term; the others are up to about twice as fast.
  SmoothSignal(RandomNumbers& random, double frequency_hz);

  [[nodiscard]] double Value(double time_s) const;
  [[nodiscard]] double Rate(double time_s) const;  ///< dValue/dt [1/s].

 private:
  struct Term {
    double amplitude;
    double omega_rps;
    double phase_rad;
  };
  std::array<Term, 3> terms_{};
};

/// Time that starts standing still and runs at normal speed after a moment; three times
/// differentiable, so that motions in it start at rest and smoothly.
struct SoftStart {
  static constexpr double kRamp_s = 0.8;
  [[nodiscard]] static double Time(double time_s);
  [[nodiscard]] static double Rate(double time_s);
};

}  // namespace disflow::host
