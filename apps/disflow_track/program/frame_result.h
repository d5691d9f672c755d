// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "disflow/estimate.h"
#include "disflow/hal/depth_sensor.h"

namespace disflow::apps {

/// What one input frame gave, for all outputs.
struct FrameResult {
  std::int64_t frame = 0;  ///< Position in the input, from 0.
  Estimate estimate;
  Counters totals;
  /// How many times coarser than set the model is, so that the object fits into it.
  float model_coarseness = 1.0F;
  std::int64_t total_ns = 0;   ///< Whole time in the tracker, without reading the frame.
  hal::SensorCounters sensor;  ///< So far.
  /// Frames so far that the recording lacks because the disk did not keep up.
  std::uint32_t recording_dropped = 0;
};

}  // namespace disflow::apps
