// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "icp_settings.h"

namespace disflow::bench {

enum class Method { kDisflow, kIcp };

struct PeerOptions {
  std::string sensor;  ///< Address as of disflow_track --sensor.
  std::string csv;     ///< Trajectory to write, as disflow_track --csv does.
  /// Empty, or the trajectory once more with every velocity extrapolated from the one before: by
  /// three poses in place of two, without their lag of half a frame, but noisier.
  std::string csv_extrapolated;
  Method method = Method::kDisflow;
  IcpSettings icp;
};

/// What a run cost, reading the frames not included.
struct PeerCost {
  int frames = 0;
  double mean_ms = 0.0;
  double median_ms = 0.0;
  double allocations_per_frame = 0.0;
  /// By which the process grew from before the method was made until its peak.
  long memory_bytes = 0;
};

/// Tracks a whole sequence. @throws apps::Failure.
[[nodiscard]] PeerCost RunPeer(const PeerOptions& options);

}  // namespace disflow::bench
