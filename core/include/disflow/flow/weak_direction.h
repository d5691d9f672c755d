// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/estimate.h"

namespace disflow {

/// The weakest direction of a pose: the axis of the largest standard deviation, of the position or
/// of the rotation, whichever exceeds its bound by more.
/// @param covariance As Estimate::pose_covariance; what is not finite counts as not weak.
/// @return kNone while both are within config.weak_std_m and config.weak_std_rad.
[[nodiscard]] WeakDirection FindWeakDirection(const Mat6& covariance,
                                              const MonitorConfig& config) noexcept;

}  // namespace disflow
