// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "estimate_csv.h"
#include "frames.h"
#include "ground_truth.h"

namespace disflow::apps {

/// One frame's estimate beside the truth, both of the true object frame.
struct AlignedFrame {
  const EstimateRow* row = nullptr;
  TruePose T_ct_estimated;  ///< T_co(k) T_co(0)^-1 T_ct(0).
  TruePose T_ct;
  PointTwist twist_estimated;  ///< Moved to the true origin: v + omega x (p_true - p_estimated).
  PointTwist twist;            ///< Zero if the sequence has no velocities.
};

/// A whole run, aligned once.
struct AlignedTrajectory {
  ObjectFromTrue T_ot;               ///< True object frame seen in the tracker's own.
  int aligned_frame = 0;             ///< Frame at which they were made equal.
  std::size_t frame_count = 0;       ///< Frames of the sequence.
  std::size_t lost = 0;              ///< Rows among `frames` whose status or state says so.
  std::size_t stamp_mismatches = 0;  ///< Rows whose time since alignment is not the sequence's.
  std::vector<AlignedFrame> frames;  ///< In order; the first is the aligned one.

  /// Frames of the sequence without an estimate: rows that are missing, refused or
  /// before alignment.
  [[nodiscard]] std::size_t missing() const { return frame_count - frames.size(); }
};

/// Whether a row says that its pose was measured; one without a status is taken for it.
[[nodiscard]] bool IsMeasured(const EstimateRow& row);

/// A model-free tracker defines its own object frame, so the estimate is made equal to the truth
/// once: at the first row whose status is "ok" (any, if there is no such column), frame 0 as a
/// rule. Lost rows are kept as they stand.
/// @throws InputError if no row can be aligned.
[[nodiscard]] AlignedTrajectory Align(const GroundTruth& truth, const EstimateTable& estimates);

}  // namespace disflow::apps
