// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory.h"

#include <algorithm>
#include <cmath>

#include "errors.h"

namespace disflow::apps {
namespace {

/// Stamps are compared since the aligned frame, for the clocks may differ; far less than a frame's
/// time.
constexpr double kStampTolerance_s = 0.002;

bool StampsDiffer(const GroundTruth& truth, const EstimateRow& first, const EstimateRow& row) {
  if (truth.stamps_s.empty()) return false;
  const double expected_s = truth.stamps_s[static_cast<std::size_t>(row.frame)] -
                            truth.stamps_s[static_cast<std::size_t>(first.frame)];
  return std::abs(row.timestamp_s - first.timestamp_s - expected_s) > kStampTolerance_s;
}

bool IsLost(const EstimateRow& row) { return !IsMeasured(row) || row.state == "lost"; }

}  // namespace

bool IsMeasured(const EstimateRow& row) { return row.status.empty() || row.status == "ok"; }

AlignedTrajectory Align(const GroundTruth& truth, const EstimateTable& estimates) {
  const auto first = std::find_if(estimates.rows.begin(), estimates.rows.end(), IsMeasured);
  if (first == estimates.rows.end()) {
    throw InputError("no row of the estimates has the status 'ok', so nothing can be aligned");
  }
  AlignedTrajectory run;
  run.frame_count = truth.T_ct.size();
  run.aligned_frame = first->frame;
  run.T_ot = first->T_co.Inverse() * truth.T_ct[static_cast<std::size_t>(first->frame)];
  for (auto row = first; row != estimates.rows.end(); ++row) {
    if (!row->has_motion) continue;  // and so counts as missing
    const auto k = static_cast<std::size_t>(row->frame);
    AlignedFrame frame;
    frame.row = &*row;
    frame.T_ct = truth.T_ct[k];
    frame.T_ct_estimated = row->T_co * run.T_ot;
    frame.twist_estimated = MoveTo(row->twist, frame.T_ct.translation() - row->T_co.translation());
    if (!truth.twists.empty()) frame.twist = truth.twists[k];
    run.frames.push_back(frame);
    if (IsLost(*row)) ++run.lost;
    if (StampsDiffer(truth, *first, *row)) ++run.stamp_mismatches;
  }
  return run;
}

}  // namespace disflow::apps
