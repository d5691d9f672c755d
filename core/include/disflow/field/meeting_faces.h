// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/field/edge_rounding.h"

namespace disflow {

/// Of the normals of faces that meet at an edge: 60 degrees and more apart.
inline constexpr float kMeetingCos = 0.5F;

/// How far the plane of either may pass from where the other ends: half a radius two deviations
/// above what is expected. Rounder things have no edge.
inline constexpr float kMeetingReach_m = 0.5F * 3.0F * kExpectedRadius_m;

}  // namespace disflow
