// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "disflow/estimate.h"
#include "disflow/hal/depth_sensor.h"

/// @file
/// What counters are called: in reports, on the page, and by those who watch many machines.

namespace disflow::apps {

template <class Counters, class Value>
struct CounterName {
  const char* words;   ///< For people.
  const char* metric;  ///< Without what all names have in common.
  Value Counters::*member;
};

inline constexpr std::array<CounterName<Counters, std::uint32_t>, Counters::kCount>
    kTrackerCounters{
        {{"frames", "frames", &Counters::frames},
         {"frames refused", "frames_refused", &Counters::frames_rejected},
         {"frames predicted only", "frames_predicted", &Counters::frames_unregistered},
         {"images repeated", "images_repeated", &Counters::images_repeated},
         {"pixels out of range", "pixels_out_of_range", &Counters::pixels_out_of_range},
         {"pixel runs dropped", "pixel_runs_dropped", &Counters::runs_dropped},
         {"blocks sparse", "blocks_sparse", &Counters::blocks_sparse},
         {"blocks grazing", "blocks_grazing", &Counters::blocks_grazing},
         {"blocks flying", "blocks_flying", &Counters::blocks_flying},
         {"samples dropped", "samples_dropped", &Counters::samples_dropped},
         {"residuals unmatched", "residuals_unmatched", &Counters::residuals_unmatched},
         {"residuals truncated", "residuals_truncated", &Counters::residuals_truncated},
         {"normals that disagree", "normals_disagreeing", &Counters::residuals_normal_mismatch},
         {"observations rejected", "observations_rejected", &Counters::observations_rejected},
         {"observations out of bounds", "observations_out_of_bounds",
          &Counters::observations_out_of_bounds},
         {"model samples refused", "model_samples_refused", &Counters::samples_refused},
         {"clusters evicted", "clusters_evicted", &Counters::clusters_evicted},
         {"clusters forgotten", "clusters_forgotten", &Counters::clusters_forgotten},
         {"edges refused", "edges_refused", &Counters::edges_refused},
         {"GP candidates dropped", "gp_candidates_dropped", &Counters::candidates_dropped}}};

inline constexpr std::array<CounterName<hal::SensorCounters, std::uint32_t>, 5> kSensorCounters{
    {{"delivered", "delivered", &hal::SensorCounters::frames},
     {"dropped", "dropped", &hal::SensorCounters::dropped},
     {"corrupt", "corrupt", &hal::SensorCounters::corrupt},
     {"stream restarts", "stream_restarts", &hal::SensorCounters::restarts},
     {"reconnects", "reconnects", &hal::SensorCounters::reconnects}}};

}  // namespace disflow::apps
