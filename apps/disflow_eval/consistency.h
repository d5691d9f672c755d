// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "statistics.h"
#include "trajectory.h"

namespace disflow::apps {

/// Quantiles of the chi-square distribution with 6 degrees of freedom.
inline constexpr double kChiSquare6At2_5 = 1.2373442457912028;
inline constexpr double kChiSquare6At95 = 12.591587243743977;
inline constexpr double kChiSquare6At97_5 = 14.449375335447922;

/// Cumulative chi-square distribution with 6 degrees of freedom.
[[nodiscard]] double ChiSquare6Cdf(double x);

/// Normalised estimation error squared e' P^-1 e of a run. A consistent filter has mean 6 and 95 %
/// of its frames between the bounds; larger values mean too small a covariance.
struct Consistency {
  std::vector<double> nees;      ///< Of the frames with a usable covariance.
  std::vector<double> by_frame;  ///< Of all frames of the run; NaN where there is none.
  Statistics statistics;
  std::size_t singular = 0;     ///< Frames whose covariance is not positive definite.
  double share_inside = 0.0;    ///< Between the 2.5 % and 97.5 % bounds.
  double share_below_95 = 0.0;  ///< Below the 95 % bound: not overconfident.
};

/// Error of the position of the tracker's own origin and rotation vector of R_estimated R_true',
/// camera axes, against the pose covariance. The aligned frame itself, exact by construction, is
/// left out.
/// @return Nothing if no frame has a covariance.
[[nodiscard]] std::optional<Consistency> EvaluatePoseConsistency(const AlignedTrajectory& run);

/// Error of (v, omega) of the tracker's own origin, camera axes, against the twist covariance.
/// @return Nothing if no frame has a covariance.
[[nodiscard]] std::optional<Consistency> EvaluateTwistConsistency(const AlignedTrajectory& run);

}  // namespace disflow::apps
