// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "disflow/config.h"
#include "disflow/depth/depth_frame.h"
#include "disflow/estimate.h"
#include "disflow/limits.h"
#include "disflow/status.h"

namespace disflow {

/// Tracks and reconstructs one rigid object (the paper's section V). Owns all of its memory by
/// value and never allocates: `static Tracker<profiles::Edge> tracker;` lives in .bss. Not
/// thread-safe; one instance per object.
/// @tparam Limits A profile of limits.h.
template <class Limits>
class Tracker {
 public:
  /// @param config Checked; see config_issue(). Process() refuses to work with an invalid one.
  explicit Tracker(const Config& config = Config{}) noexcept;
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;

  /// The whole pipeline on one frame: segment, sample, predict, register, filter, fuse, retrain.
  /// @param estimate Always written completely. Its pose and twist are predictions if the status is
  /// not ok.
  /// @return Same as estimate.status. A refused frame changes nothing but the counters.
  Status Process(const DepthFrame& frame, Estimate& estimate, StageClock clock = {}) noexcept;

  /// Fuses a frame whose pose is known (turntable, robot arm) instead of estimating it.
  /// The first call fixes nothing: the object frame is the caller's.
  Status Fuse(const DepthFrame& frame, const PoseObjectFromCamera& T_oc, Estimate& estimate,
              StageClock clock = {}) noexcept;

  /// Forgets the object; the next frame starts a new one and bumps reset_counter.
  void Reset() noexcept;

  [[nodiscard]] const ConfigIssue& config_issue() const noexcept;
  /// Sums of Estimate::rejected since construction, saturating.
  [[nodiscard]] const Counters& totals() const noexcept;
};

}  // namespace disflow
