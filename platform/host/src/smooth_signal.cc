// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/host/smooth_signal.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace disflow::host {

SmoothSignal::SmoothSignal(RandomNumbers& random, double frequency_hz) {
  constexpr std::array<double, 3> kAmplitudes{0.6, 0.28, 0.12};
  // Ratios that share no small period keep the motion from repeating.
  constexpr std::array<double, 3> kRatios{1.0, 1.47, 2.13};
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const double jitter = random.Uniform(0.9, 1.1);
    terms_[i] = {kAmplitudes[i], 2.0 * std::numbers::pi * frequency_hz * kRatios[i] * jitter,
                 random.Uniform(0.0, 2.0 * std::numbers::pi)};
  }
}

double SmoothSignal::Value(double time_s) const {
  double sum = 0.0;
  for (const Term& term : terms_) {
    sum += term.amplitude * std::sin(term.omega_rps * time_s + term.phase_rad);
  }
  return sum;
}

double SmoothSignal::Rate(double time_s) const {
  double sum = 0.0;
  for (const Term& term : terms_) {
    sum += term.amplitude * term.omega_rps * std::cos(term.omega_rps * time_s + term.phase_rad);
  }
  return sum;
}

double SoftStart::Time(double time_s) {
  if (time_s >= kRamp_s) return time_s - 0.5 * kRamp_s;
  const double x = std::max(0.0, time_s / kRamp_s);
  return kRamp_s * x * x * x * x * (2.5 + x * (x - 3.0));  // integral of Rate
}

double SoftStart::Rate(double time_s) {
  const double x = std::clamp(time_s / kRamp_s, 0.0, 1.0);
  return x * x * x * (10.0 + x * (6.0 * x - 15.0));
}

}  // namespace disflow::host
