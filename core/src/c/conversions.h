// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow.h"
#include "disflow/depth/depth_frame.h"
#include "disflow/estimate.h"
#include "disflow/surface_extractor.h"

namespace disflow::c {

/// What is not rigid (no unit quaternion) comes out as a motion that is not finite, which the
/// tracker refuses by its own rules.
template <class To, class From>
[[nodiscard]] Transform<To, From> TransformOf(const disflow_pose& pose) noexcept;

/// @param frame Its pixels are not copied.
[[nodiscard]] DepthFrame FrameOf(const disflow_frame& frame) noexcept;

/// As it may leave the library: that of a refused frame holds no pose.
[[nodiscard]] disflow_estimate EstimateOf(const Estimate& estimate) noexcept;

[[nodiscard]] disflow_vertex VertexOf(const SurfaceVertex& vertex) noexcept;

}  // namespace disflow::c
