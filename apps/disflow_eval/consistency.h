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

/// How far off the truth itself is, as a standard deviation in each direction, of independent
/// errors from frame to frame. A reference that was measured has some; a simulator's truth has
/// none.
struct TruthDeviation {
  double position_m = 0.0;  ///< Of the true object frame's origin.
  double rotation_rad = 0.0;
  double linear_mps = 0.0;  ///< Of the velocity of that origin.
  double angular_rps = 0.0;
};

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
/// camera axes, against the pose covariance and what the truth is off by: in the frame itself, and
/// in the aligned one, whose error is in all. The aligned frame itself, exact by construction, is
/// left out.
/// @return Nothing if no frame has a covariance.
[[nodiscard]] std::optional<Consistency> EvaluatePoseConsistency(const AlignedTrajectory& run,
                                                                 const TruthDeviation& truth = {});

/// Error of (v, omega) of the tracker's own origin, camera axes, against the twist covariance and
/// what the truth is off by.
/// @return Nothing if no frame has a covariance.
[[nodiscard]] std::optional<Consistency> EvaluateTwistConsistency(const AlignedTrajectory& run,
                                                                  const TruthDeviation& truth = {});

}  // namespace disflow::apps
