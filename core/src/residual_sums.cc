// SPDX-License-Identifier: BSD-3-Clause
#include "disflow/flow/residual_sums.h"

#include <cmath>

namespace disflow {
namespace {

/// Sums of weights below this are none.
constexpr float kNoWeight = 1e-9F;
}  // namespace

float ResidualSums::mean_generation() const noexcept {
  return weighted_generation / std::fmax(weight, kNoWeight);
}

float ResidualSums::mean_tilt_rad2() const noexcept {
  return information > 0.0F ? std::fmax(informed_tilt_rad2 / information, 0.0F) : 0.0F;
}

float ResidualSums::rms_m() const noexcept {
  return std::sqrt(weighted_square_m2 / std::fmax(weight, kNoWeight));
}

float ResidualSums::std_m() const noexcept {
  return information > 0.0F ? std::sqrt(weight / information) : 0.0F;
}

}  // namespace disflow
